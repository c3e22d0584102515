// The sheet on paper: one page of its own size, or A4 sheets to be glued.
#include <algorithm>
#include <cmath>

#include "pdf_canvas.h"
#include "sheet.h"

namespace karinui {
namespace {

constexpr double kLargestPage = 5000;  // mm; PDF ends at 14400 points
constexpr double kA4Width = 210, kA4Height = 297, kEdge = 10, kOverlap = 10;
constexpr double kStepX = kA4Width - 2 * kEdge - kOverlap, kStepY = kA4Height - 2 * kEdge - kOverlap;

void drawOutline(PdfCanvas& canvas, const SheetPiece& piece, const Outline& outline) {
  canvas.moveTo(piece.at(outline.edges[0].curve.start));
  for (const Edge& edge : outline.edges) canvas.curve(piece, edge.curve);
  canvas.close();
}

void drawArrowHead(PdfCanvas& canvas, Mm tip, Mm from) {
  const Mm along = tip - from;
  const double size = std::hypot(along.x, along.y);
  if (size < 1) return;
  const Mm unit = along * (1 / size), across{-unit.y, unit.x};
  canvas.moveTo(tip);
  canvas.lineTo(tip - unit * 7 + across * 2.5);
  canvas.lineTo(tip - unit * 7 - across * 2.5);
  canvas.close();
  canvas.fill();
}

void drawPiece(PdfCanvas& canvas, const SheetPiece& piece) {
  canvas.colour(0);
  for (const auto& line : piece.cutLines) {
    canvas.moveTo(line[0]);
    for (std::size_t i = 1; i < line.size(); ++i) canvas.lineTo(line[i]);
    canvas.close();
    canvas.stroke(0.6, false);
  }
  drawOutline(canvas, piece, piece.piece->outline);
  canvas.stroke(piece.cutLines.empty() ? 0.6 : 0.35, !piece.cutLines.empty());
  for (const Outline& hole : piece.piece->holes) {
    drawOutline(canvas, piece, hole);
    canvas.stroke(0.35, true);
  }
  for (const InternalLine& line : piece.piece->lines)
    for (const Curve& curve : line.curves) {
      canvas.moveTo(piece.at(curve.start));
      canvas.curve(piece, curve);
      canvas.stroke(0.25, true);
    }
  for (const SheetNotch& notch : piece.notches) {
    canvas.moveTo(notch.stroke.from);
    canvas.lineTo(notch.stroke.to);
    canvas.stroke(0.7, false);
  }
  for (const Mm place : piece.drills) {
    canvas.circle(place, 2.5);
    for (const Mm arm : {Mm{4, 0}, Mm{0, 4}}) canvas.moveTo(place - arm), canvas.lineTo(place + arm);
    canvas.stroke(0.35, false);
  }
  if (piece.grain) {
    canvas.moveTo(piece.grain->from);
    canvas.lineTo(piece.grain->to);
    canvas.stroke(0.5, false);
    drawArrowHead(canvas, piece.grain->to, piece.grain->from);
    drawArrowHead(canvas, piece.grain->from, piece.grain->to);
  }
  for (std::size_t i = 0; i < piece.texts.size(); ++i) {
    canvas.colour(i < 2 ? 0 : 0.2);
    canvas.words(piece.texts[i], true);
  }
}

void drawSheet(PdfCanvas& canvas, const Sheet& sheet) {
  canvas.colour(0);
  const Mm low = sheet.square, high = low + Mm{kSquare, kSquare};
  canvas.moveTo(low), canvas.lineTo({high.x, low.y}), canvas.lineTo(high), canvas.lineTo({low.x, high.y});
  canvas.close();
  canvas.stroke(0.35, false);
  canvas.words({low + Mm{kSquare / 2, kSquare / 2}, 6, true, "100 × 100 mm"}, true);
  for (const SheetText& heading : sheet.headings) canvas.words(heading, false);
  for (const SheetPiece& piece : sheet.pieces) drawPiece(canvas, piece);
}

struct Tile {
  std::size_t row = 0, column = 0;
  Mm low() const { return {static_cast<double>(column) * kStepX, static_cast<double>(row) * kStepY}; }
  Mm high() const { return low() + Mm{kStepX + kOverlap, kStepY + kOverlap}; }
  std::string name() const {  // A1 … Z9, AA1 …
    std::string letters;
    for (std::size_t n = row + 1; n > 0; n = (n - 1) / 26)
      letters.insert(letters.begin(), static_cast<char>('A' + (n - 1) % 26));
    return letters + std::to_string(column + 1);
  }
};

bool boxesMeet(Mm lowA, Mm highA, Mm lowB, Mm highB) {
  return lowA.x < highB.x && lowB.x < highA.x && lowA.y < highB.y && lowB.y < highA.y;
}

// Whether any paper of a piece lies on the tile: a line of it crosses the tile, or the tile lies all within it.
bool pieceOn(const Tile& tile, const SheetPiece& piece) {
  if (!boxesMeet(tile.low(), tile.high(), piece.low, piece.high)) return false;
  Ring ring;
  if (piece.cutLines.empty())
    for (const Flat p : piece.piece->outline.flattened(1e-4)) ring.push_back({piece.at(p).x, piece.at(p).y});
  else
    for (const Mm p : piece.cutLines[0]) ring.push_back({p.x, p.y});
  const Mm low = tile.low(), high = tile.high();
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

std::vector<Tile> tilesOf(const Sheet& sheet) {
  const auto count = [](double size, double step) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil((size - kOverlap) / step)));
  };
  std::vector<Tile> out;
  for (std::size_t row = 0; row < count(sheet.height, kStepY); ++row)
    for (std::size_t column = 0; column < count(sheet.width, kStepX); ++column) {
      const Tile tile{row, column};
      bool used = row == 0 && column == 0;  // the test square
      for (const SheetText& words : sheet.headings)
        used |= boxesMeet(tile.low(), tile.high(), words.place - Mm{0, words.size},
                          words.place + Mm{wordsWidth(words.words, words.size), words.size});
      for (const SheetPiece& piece : sheet.pieces) used |= pieceOn(tile, piece);
      if (used) out.push_back(tile);
    }
  return out;
}

// Frame, joins and the sheet's name. At every join two half diamonds come together when the sheets lie right.
void drawJoins(PdfCanvas& canvas, const Tile& tile, std::size_t page, std::size_t pages,
               const SheetSettings& settings) {
  const Mm low{kEdge, kEdge}, high{kA4Width - kEdge, kA4Height - kEdge}, cut{high.x - kOverlap, high.y - kOverlap};
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
  const Message where =
      say("Sheet {0} · page {1} of {2} · glue over the strip at the right and below", tile.name(), page, pages);
  canvas.words({{low.x + 2, high.y - 3}, 3, true, text(where, settings.language)}, false);
}

}  // namespace

Result<std::string> writePdf(const Pattern& pattern, PaperKind paper, const SheetSettings& settings) {
  Result<Sheet> sheet = layOut(pattern, settings);
  // A page that would be too long becomes wider instead.
  for (SheetSettings wider = settings;
       sheet && sheet->height > kLargestPage && paper == PaperKind::OneSheet && wider.rollWidth < 4;) {
    wider.rollWidth *= 1.5;
    sheet = layOut(pattern, wider);
  }
  if (!sheet) return sheet.error();
  if (paper == PaperKind::OneSheet) {
    if (sheet->height > kLargestPage || sheet->width > kLargestPage)
      return refused(say("The pieces need a page larger than 5 m, which PDF does not have. Print them on A4 sheets."));
    PdfCanvas canvas(sheet->width, sheet->height, sheet->title);
    canvas.begin(sheet->width, sheet->height);
    drawSheet(canvas, *sheet);
    canvas.end();
    return canvas.finish();
  }
  PdfCanvas canvas(kA4Width, kA4Height, sheet->title);
  const std::vector<Tile> tiles = tilesOf(*sheet);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    canvas.begin(kA4Width, kA4Height);
    canvas.push({kEdge, kEdge}, {kA4Width - kEdge, kA4Height - kEdge}, Mm{kEdge, kEdge} - tiles[i].low());
    drawSheet(canvas, *sheet);
    canvas.pop();
    drawJoins(canvas, tiles[i], i + 1, tiles.size(), settings);
    canvas.end();
  }
  return canvas.finish();
}

}  // namespace karinui
