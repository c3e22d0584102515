#include "page_nest.h"

#include <algorithm>
#include <cmath>

#include "karinui/geometry/nest.h"
#include "karinui/pattern/label_room.h"

namespace karinui {
namespace {

constexpr double kBorder = 5, kBetween = 8;  // mm: from the sheet's sides, between pieces
constexpr std::size_t kMostPagesWide = 8;    // of pages
constexpr std::size_t kMostNested = 60;      // more are left as they lie
constexpr int kTries = 1500;

// Without points that a line between their neighbours misses by next to nothing: the finer, the slower.
Ring thinned(const Ring& ring) {
  constexpr double kMiss = 0.0003, kLongest = 0.03;  // metres
  Ring out;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Flat at = ring[k], next = ring[(k + 1) % ring.size()];
    if (!out.empty() && distance(out.back(), next) < kLongest &&
        std::abs(cross(next - out.back(), at - out.back())) < kMiss * distance(out.back(), next))
      continue;
    out.push_back(at);
  }
  return out;
}

// The strip runs down the sheet: its length is y, its width x, both in metres from the top left of the pieces.
Ring onStrip(const SheetPiece& piece) {
  Ring ring;
  if (!piece.nest.empty())  // all sizes together: their box
    ring = {{piece.low.y, piece.low.x},
            {piece.low.y, piece.high.x},
            {piece.high.y, piece.high.x},
            {piece.high.y, piece.low.x}};
  else if (!piece.cutLines.empty())
    for (const Mm p : piece.cutLines[0]) ring.push_back({p.y, p.x});
  else
    for (const Flat p : piece.piece->outline.flattened(1e-4)) ring.push_back({piece.at(p).y, piece.at(p).x});
  for (Flat& p : ring) p = (p - Flat{piece.low.y, piece.low.x}) * 0.001;
  if (signedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
  return thinned(ring);
}

}  // namespace

void nestOnPages(Sheet& sheet, const TileGrid& grid) {
  if (sheet.pieces.empty() || sheet.pieces.size() > kMostNested) return;
  std::vector<NestShape> shapes;
  std::vector<NestItem> items;
  double widest = 0, top = sheet.height;
  for (const SheetPiece& piece : sheet.pieces) {
    items.push_back({{shapes.size()}, false});
    shapes.push_back({onStrip(piece), {}});
    widest = std::max(widest, piece.high.x - piece.low.x);
    top = std::min(top, piece.low.y);
  }
  Workers alone;
  std::size_t fewest = tilesOf(sheet, grid).size();
  Sheet best = sheet;
  for (std::size_t columns = 1; columns <= (grid.cover ? kMostPagesWide : 1); ++columns) {
    const double room = static_cast<double>(columns) * grid.step().x + grid.overlap - 2 * kBorder;
    if (room < widest) continue;
    NestSettings settings;
    settings.width = room / 1000, settings.gap = kBetween / 1000, settings.tries = kTries;
    const auto nested = nest(shapes, items, settings, alone, Token());
    if (!nested || nested->homeless) continue;
    Sheet tried = sheet;
    tried.width = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      SheetPiece& piece = tried.pieces[i];
      const Flat at = nested->places[i].at;
      moveBy(piece, Mm{kBorder + at.v * 1000, top + at.u * 1000} - piece.low);
      tried.width = std::max(tried.width, piece.high.x + kBorder);
    }
    for (const SheetText& words : tried.headings)
      tried.width = std::max(tried.width, words.place.x + wordsWidth(words.words, words.size) + kBorder);
    tried.width = std::ceil(tried.width), tried.height = std::ceil(top + nested->length * 1000 + kBorder);
    if (const std::size_t pages = tilesOf(tried, grid).size(); pages < fewest) fewest = pages, best = std::move(tried);
  }
  sheet = std::move(best);
}

}  // namespace karinui
