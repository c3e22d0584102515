#pragma once
// A sheet cut into A4 pages that are glued together: which pages there are, their joins, and the overview before them.
#include <string>
#include <vector>

#include "pdf_canvas.h"
#include "sheet.h"

namespace karinui {

inline constexpr double kA4Width = 210, kA4Height = 297, kEdge = 10, kOverlap = 10;  // mm

struct Tile {
  std::size_t row = 0, column = 0;
  Mm low() const;  // on the sheet
  Mm high() const;
  std::string name() const;  // A1 … Z9, AA1 …
};

// Those with anything on them, row by row.
std::vector<Tile> tilesOf(const Sheet& sheet);

// Frame, joins and the tile's name. At every join two half diamonds come together when the sheets lie right.
void drawJoins(PdfCanvas& canvas, const Tile& tile, std::size_t page, std::size_t pages, const SheetSettings& settings);

// The first page: the whole sheet small, how its pages lie, and the square at true size.
void drawOverview(PdfCanvas& canvas, const Sheet& sheet, const std::vector<Tile>& tiles, const SheetSettings& settings);
// The square and its words, its top left where it is wanted.
void drawSquare(PdfCanvas& canvas, Mm low);

}  // namespace karinui
