#pragma once
// A sheet cut into pages that are glued together: which pages there are, their joins, and the cover before them.
#include <optional>
#include <string>
#include <vector>

#include "sheet.h"

namespace karinui {

class PdfCanvas;

inline constexpr double kEdge = 10;  // mm that printers leave white round a page

// How a sheet is divided: pages of one size whose neighbours overlap by a strip. Millimetres.
struct TileGrid {
  double width = 210, height = 297, overlap = 10;
  bool cover = true;  // before the pages; large ones bear the squares and the words themselves
  Mm step() const { return {width - 2 * kEdge - overlap, height - 2 * kEdge - overlap}; }
};
// Nothing: one sheet, which is not divided.
std::optional<TileGrid> gridFor(PaperKind paper, const SheetSettings& settings);

struct Tile {
  std::size_t row = 0, column = 0;
  Mm low, high;              // on the sheet
  std::string name() const;  // A1 … Z9, AA1 …
};

// Those with anything on them, row by row.
std::vector<Tile> tilesOf(const Sheet& sheet, const TileGrid& grid);

// Frame, joins and the tile's name. At every join two half diamonds come together when the sheets lie right.
void drawJoins(PdfCanvas& canvas, const TileGrid& grid, const Tile& tile, std::size_t page, std::size_t pages,
               const SheetSettings& settings);

// The first page: what to do, the whole sheet small, how its pages lie, and the squares at true size.
void drawCover(PdfCanvas& canvas, const TileGrid& grid, const Sheet& sheet, const std::vector<Tile>& tiles,
               const SheetSettings& settings);
// In which order it is sewn, on pages of its own behind the cover.
std::vector<std::vector<std::string>> orderPages(const TileGrid& grid, const SheetSettings& settings);
void drawOrder(PdfCanvas& canvas, const std::vector<std::string>& lines);
// A square of 100 mm and one of 4 inches about it, their top left where it is wanted.
void drawSquares(PdfCanvas& canvas, Mm low);

}  // namespace karinui
