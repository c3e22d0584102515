#include "pdf_tiles.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/label_room.h"
#include "names.h"
#include "pdf_canvas.h"

namespace karinui {
namespace {

constexpr double kInch = 25.4;
constexpr double kLeastRead = 0.9;  // mm, of letters on the cover
bool boxesMeet(Mm lowA, Mm highA, Mm lowB, Mm highB) {
  return lowA.x < highB.x && lowB.x < highA.x && lowA.y < highB.y && lowB.y < highA.y;
}

// Whether any paper of a piece lies on the tile: a line of it crosses the tile, or the tile lies all within it.
bool pieceOn(const Tile& tile, const SheetPiece& piece) {
  if (!boxesMeet(tile.low, tile.high, piece.low, piece.high)) return false;
  Ring ring;
  if (piece.cutLines.empty())
    for (const Flat p : piece.piece->outline.flattened(1e-4)) ring.push_back({piece.at(p).x, piece.at(p).y});
  else
    for (const Mm p : piece.cutLines[0]) ring.push_back({p.x, p.y});
  const Mm low = tile.low, high = tile.high;
  if (contains(ring, {(low.x + high.x) / 2, (low.y + high.y) / 2})) return true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // The part of the segment within the tile (Liang and Barsky): empty if its bounds pass each other.
    const Flat a = ring[i], along = ring[(i + 1) % ring.size()] - a;
    double from = 0, to = 1;
    const auto bound = [&](double step, double room) {
      if (step == 0) return room >= 0;
      (step > 0 ? to : from) = step > 0 ? std::min(to, room / step) : std::max(from, room / step);
      return true;
    };
    if (bound(along.u, high.x - a.u) && bound(-along.u, a.u - low.x) && bound(along.v, high.y - a.v) &&
        bound(-along.v, a.v - low.y) && from < to)
      return true;
  }
  return false;
}

}  // namespace

std::optional<TileGrid> gridFor(PaperKind paper, const SheetSettings& settings) {
  const double overlap = settings.overlap * 1000;
  switch (paper) {
    case PaperKind::A4:
      return TileGrid{210, 297, overlap, true};
    case PaperKind::Letter:
      return TileGrid{8.5 * kInch, 11 * kInch, overlap, true};
    case PaperKind::A3:
      return TileGrid{297, 420, overlap, true};
    case PaperKind::A0:
      return TileGrid{841, 1189, overlap, false};
    case PaperKind::Inches36:
      return TileGrid{36 * kInch, 48 * kInch, overlap, false};
    default:
      return std::nullopt;
  }
}

std::string Tile::name() const {
  std::string letters;
  for (std::size_t n = row + 1; n > 0; n = (n - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (n - 1) % 26));
  return letters + std::to_string(column + 1);
}

std::vector<Tile> tilesOf(const Sheet& sheet, const TileGrid& grid) {
  const Mm step = grid.step();
  const auto count = [&](double size, double by) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil((size - grid.overlap) / by - 1e-9)));
  };
  std::vector<Tile> out;
  for (std::size_t row = 0; row < count(sheet.height, step.y); ++row)
    for (std::size_t column = 0; column < count(sheet.width, step.x); ++column) {
      const Mm low{static_cast<double>(column) * step.x, static_cast<double>(row) * step.y};
      const Tile tile{row, column, low, low + step + Mm{grid.overlap, grid.overlap}};
      bool used = row == 0 && column == 0;  // the test squares
      for (const SheetText& words : sheet.headings)
        used |= boxesMeet(tile.low, tile.high, words.place - Mm{0, words.size},
                          words.place + Mm{wordsWidth(words.words, words.size), words.size});
      for (const SheetPiece& piece : sheet.pieces) used |= pieceOn(tile, piece);
      if (used) out.push_back(tile);
    }
  return out;
}

void drawJoins(PdfCanvas& canvas, const TileGrid& grid, const Tile& tile, std::size_t page, std::size_t pages,
               const SheetSettings& settings) {
  const Mm low{kEdge, kEdge}, high{grid.width - kEdge, grid.height - kEdge},
      cut{high.x - grid.overlap, high.y - grid.overlap};
  canvas.layer(PdfLayer::Page);
  canvas.colour(0.45);
  canvas.moveTo(low), canvas.lineTo({high.x, low.y}), canvas.lineTo(high), canvas.lineTo({low.x, high.y}),
      canvas.close();
  canvas.stroke(0.2, false);
  canvas.moveTo({cut.x, low.y}), canvas.lineTo({cut.x, high.y});
  canvas.moveTo({low.x, cut.y}), canvas.lineTo({high.x, cut.y});
  canvas.stroke(0.2, true);
  const double middleX = (low.x + cut.x) / 2, middleY = (low.y + cut.y) / 2, size = 5;
  const auto half = [&](Mm at, Mm along, Mm into) {
    canvas.moveTo(at - along * size), canvas.lineTo(at + into * size), canvas.lineTo(at + along * size), canvas.close();
    canvas.fill();
  };
  half({cut.x, middleY}, {0, 1}, {-1, 0});
  half({middleX, cut.y}, {1, 0}, {0, -1});
  if (tile.column > 0) half({low.x, middleY}, {0, 1}, {1, 0});
  if (tile.row > 0) half({middleX, low.y}, {1, 0}, {0, 1});
  canvas.words({{low.x + 4, low.y + 6}, 8, true, tile.name()}, false);
  const Message where = say("Sheet {0} · page {1} of {2} · the next sheets lie on the strips at the right and below",
                            tile.name(), page, pages);
  canvas.words({{low.x + 2, high.y - 3}, 3, true, text(where, settings.language)}, false);
}

void drawSquares(PdfCanvas& canvas, Mm low) {
  const auto square = [&](double side, bool dashed) {
    const Mm high = low + Mm{side, side};
    canvas.moveTo(low), canvas.lineTo({high.x, low.y}), canvas.lineTo(high), canvas.lineTo({low.x, high.y});
    canvas.close();
    canvas.stroke(dashed ? 0.2 : 0.35, dashed);
  };
  canvas.layer(PdfLayer::Page);
  square(kSquare, false);
  square(4 * kInch, true);
  canvas.words({low + Mm{kSquare / 2, kSquare / 2}, 6, true, "100 × 100 mm"}, true);
  canvas.words({low + Mm{kSquare / 2, kSquare - 5}, 4, true, "- - -  4 × 4 in"}, true);
}

constexpr double kOrderSize = 4, kOrderDown = 1.9 * kOrderSize;  // mm

std::vector<std::vector<std::string>> orderPages(const TileGrid& grid, const SheetSettings& settings) {
  const double wide = grid.width - 2 * kEdge;
  const auto most = static_cast<std::size_t>((grid.height - 2 * kEdge) / kOrderDown);
  std::vector<std::vector<std::string>> pages;
  for (const std::string& whole : orderLines(settings))
    for (const std::string& line :
         brokenInto(whole, wide, [](std::string_view part) { return wordsWidth(part, kOrderSize); })) {
      if (pages.empty() || pages.back().size() == most) pages.emplace_back();
      pages.back().push_back(line);
    }
  return pages;
}

void drawOrder(PdfCanvas& canvas, const std::vector<std::string>& lines) {
  canvas.layer(PdfLayer::Page);
  canvas.colour(0);
  Mm at{kEdge, kEdge + kOrderSize};
  for (const std::string& line : lines) canvas.words({at, kOrderSize, true, line}, false), at.y += kOrderDown;
}

void drawCover(PdfCanvas& canvas, const TileGrid& grid, const Sheet& sheet, const std::vector<Tile>& tiles,
               const SheetSettings& settings) {
  const auto said = [&](const Message& message) { return text(message, settings.language); };
  const double size = 3.4, wide = grid.width - 2 * kEdge;
  canvas.layer(PdfLayer::Page);
  canvas.colour(0);
  canvas.words({{kEdge, kEdge + 6}, 7, true, sheet.title}, false);
  double down = kEdge + 15;
  const std::string lines[] = {
      said(say("1. Print this page at 100 % (“actual size”). The square must measure 100 mm, the dashed one 4 in.")),
      said(say("2. Print the other {0} {0|page|pages}. Letters are rows, numbers columns; A1 is at the top left.",
               tiles.size() + orderPages(grid, settings).size())),
      said(say("3. Lay each sheet on the strip of the one to its left and above, border on the dashed line,")),
      said(say("so that the half diamonds become whole ones, and glue.")),
      said(say("4. Cut the paper along the solid lines. Lines and words that are not wanted can be hidden first,")),
      said(say("in the list of layers of the program that shows this PDF.")),
  };
  for (const std::string& line : lines) {
    const double fits = std::min(size, size * wide / std::max(1.0, wordsWidth(line, size)));
    canvas.words({{kEdge, down}, fits, true, line}, false);
    down += 1.6 * size;
  }
  const double foot = 4 * kInch;
  const Mm low{kEdge, down + 4}, room{wide, grid.height - kEdge - foot - 6 - low.y};
  Mm all = tiles.back().high;
  for (const Tile& tile : tiles) all = {std::max(all.x, tile.high.x), std::max(all.y, tile.high.y)};
  const double scale = std::min({room.x / all.x, room.y / all.y, 1.0});
  const auto at = [&](Mm p) { return low + p * scale; };
  canvas.colour(0.6);
  for (const Tile& tile : tiles) {
    const Mm a = at(tile.low), b = at(tile.low + grid.step());
    canvas.moveTo(a), canvas.lineTo({b.x, a.y}), canvas.lineTo(b), canvas.lineTo({a.x, b.y}), canvas.close();
    canvas.stroke(0.2, false);
    const double letters = std::min(4.0, 60 * scale);
    canvas.words({a + Mm{1, letters * 0.8}, letters, true, tile.name()}, false);
  }
  canvas.colour(0);
  for (const SheetPiece& piece : sheet.pieces) {
    const std::vector<Flat> ring = piece.piece->outline.flattened(5e-4);
    for (std::size_t i = 0; i < ring.size(); ++i)
      i == 0 ? canvas.moveTo(at(piece.at(ring[i]))) : canvas.lineTo(at(piece.at(ring[i])));
    canvas.close();
    canvas.stroke(0.3, false);
    SheetText name = piece.texts.front();
    name.place = at(name.place);
    // No wider than its piece, or left out where that is too small to be read.
    const double longest = scale * (name.upright ? piece.high.x - piece.low.x : piece.high.y - piece.low.y);
    name.size = std::min(std::clamp(name.size * scale, 1.8, 4.0), 0.9 * longest / wordsWidth(name.words, 1));
    if (name.size >= kLeastRead) canvas.words(name, true);
  }
  drawSquares(canvas, {kEdge, grid.height - kEdge - foot});
}

}  // namespace karinui
