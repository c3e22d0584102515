// A sheet as plain lines in place: DXF for cutters and drawing programs, HPGL for plotters.
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/exchange/hpgl.h"
#include "names.h"
#include "sheet.h"

namespace karinui {
namespace {

constexpr double kMiss = 4e-5;  // metres between a curve and its chords

std::vector<Mm> ring(const SheetPiece& piece, const Outline& outline) {
  std::vector<Mm> points;
  for (const Edge& edge : outline.edges) {
    const std::vector<Flat> line = edge.curve.flattened(kMiss);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) points.push_back(piece.at(line[i]));
  }
  return points;
}

}  // namespace

void eachLine(const SheetPiece& piece, const SheetLine& line) {
  const bool cut = !piece.cutLines.empty();
  for (std::size_t i = 0; i < piece.cutLines.size(); ++i)
    line(i == 0 ? SheetLayer::Boundary : SheetLayer::CutOut, piece.cutLines[i], true);
  line(cut ? SheetLayer::Seam : SheetLayer::Boundary, ring(piece, piece.piece->outline), true);
  for (std::size_t k = 0; k < piece.piece->holes.size(); ++k)
    line(cut || piece.foldedHoles.contains(k) ? SheetLayer::Seam : SheetLayer::CutOut,
         ring(piece, piece.piece->holes[k]), true);
  for (const InternalLine& inner : piece.piece->lines) {
    std::vector<Mm> points;
    for (const Curve& curve : inner.curves) {
      const std::vector<Flat> part = curve.flattened(kMiss);
      if (points.empty() ||
          std::hypot(points.back().x - piece.at(part[0]).x, points.back().y - piece.at(part[0]).y) > 1e-3) {
        if (points.size() > 1) line(SheetLayer::Inner, points, false);
        points = {piece.at(part[0])};
      }
      for (std::size_t i = 1; i < part.size(); ++i) points.push_back(piece.at(part[i]));
    }
    if (points.size() > 1) line(SheetLayer::Inner, points, false);
  }
  for (const SheetStitches& row : piece.stitches) line(SheetLayer::Topstitch, row.line, false);
  for (const std::vector<Mm>& trim : piece.trims) line(SheetLayer::Topstitch, trim, false);
  for (const SheetNotch& notch : piece.notches) line(SheetLayer::Notch, {notch.stroke.from, notch.stroke.to}, false);
  for (const Mm drill : piece.drills)
    for (const Mm arm : {Mm{kDrillArm * 1000, 0}, Mm{0, kDrillArm * 1000}})
      line(SheetLayer::Drill, {drill - arm, drill + arm}, false);
  if (piece.grain) line(SheetLayer::Grain, {piece.grain->from, piece.grain->to}, false);
  for (const std::vector<Mm>& fold : piece.folds) line(SheetLayer::Grain, fold, false);
}

namespace {

std::string ascii(std::string_view words) {
  std::string out;
  for (const char c : words) out += c >= ' ' && c <= '~' ? c : '_';
  return out;
}

}  // namespace

std::string dxfOf(const Sheet& sheet) {
  std::string out;
  const auto group = [&](int code, std::string_view value) {
    out.append(std::to_string(code)).append("\r\n").append(value).append("\r\n");
  };
  const auto place = [&](Mm p) { group(10, fixed(p.x, 4)), group(20, fixed(sheet.height - p.y, 4)), group(30, "0"); };
  const SheetLine line = [&](SheetLayer layer, const std::vector<Mm>& points, bool closed) {
    const std::string on = std::to_string(static_cast<int>(layer));
    group(0, "POLYLINE"), group(8, on), group(66, "1"), place({0, sheet.height}), group(70, closed ? "1" : "0");
    for (const Mm p : points) group(0, "VERTEX"), group(8, on), place(p);
    group(0, "SEQEND"), group(8, on);
  };
  const auto words = [&](const SheetText& text, double turn) {
    group(0, "TEXT"), group(8, std::to_string(static_cast<int>(SheetLayer::Words))), place(text.place),
        group(40, fixed(text.size, 2)), group(1, ascii(text.words));
    if (turn != 0) group(50, fixed(turn, 1));
  };
  group(0, "SECTION"), group(2, "HEADER"), group(9, "$ACADVER"), group(1, "AC1009"), group(9, "$INSUNITS"),
      group(70, "4"), group(9, "$MEASUREMENT"), group(70, "1"), group(0, "ENDSEC");
  group(0, "SECTION"), group(2, "ENTITIES");
  for (const std::vector<Mm>& border : sheet.borders) line(SheetLayer::Words, border, false);
  const Mm square = sheet.square;
  line(SheetLayer::Words, {square, square + Mm{kSquare, 0}, square + Mm{kSquare, kSquare}, square + Mm{0, kSquare}},
       true);
  for (const SheetText& heading : sheet.headings) words(heading, 0);
  for (const SheetPiece& piece : sheet.pieces) {
    eachLine(piece, line);
    for (const SheetText& text : piece.texts) words(text, text.upright ? 0 : 90);
  }
  group(0, "ENDSEC"), group(0, "EOF");
  return out;
}

// HP-GL (Hewlett-Packard 7475A manual): a unit is 0.025 mm; x runs along the roll, which is the sheet's length.
std::string hpglOf(const Sheet& sheet) {
  constexpr double kPerMillimetre = 40;  // units of the drawing
  const auto unit = [](double mm) { return std::to_string(std::lround(mm * kPerMillimetre)); };
  const auto place = [&](Mm p) { return unit(p.y) + "," + unit(p.x); };
  std::string out = "IN;\nPS" + unit(sheet.height) + "," + unit(sheet.width) + ";\nSP1;\n";
  const SheetLine line = [&](SheetLayer, const std::vector<Mm>& points, bool closed) {
    out += "PU" + place(points[0]) + ";PD";
    for (std::size_t i = 1; i < points.size(); ++i) out += (i > 1 ? "," : "") + place(points[i]);
    if (closed) out += "," + place(points[0]);
    out += ";PU;\n";
  };
  const auto words = [&](const SheetText& text, bool centred) {
    // Along the roll is to the right of the plotter: what is upright on the sheet is written against it.
    const std::string letters = ascii(text.words);
    const double tall = text.size / 10, wide = tall * 0.6;  // cm
    const Mm along = text.upright ? Mm{1, 0} : Mm{0, -1};
    const Mm at =
        centred ? text.place - along * (0.5 * wide * 10 * 1.5 * static_cast<double>(letters.size())) : text.place;
    out += "SI" + fixed(wide, 3) + "," + fixed(tall, 3) + ";DI" + fixed(along.y, 0) + "," + fixed(along.x, 0) + ";PU" +
           place(at) + ";LB" + letters + "\x03;\n";
  };
  for (const std::vector<Mm>& border : sheet.borders) line(SheetLayer::Words, border, false);
  const Mm square = sheet.square;
  line(SheetLayer::Words, {square, square + Mm{kSquare, 0}, square + Mm{kSquare, kSquare}, square + Mm{0, kSquare}},
       true);
  for (const SheetText& heading : sheet.headings) words(heading, false);
  for (const SheetPiece& piece : sheet.pieces) {
    eachLine(piece, line);
    for (const SheetText& text : piece.texts) words(text, true);
  }
  return out + "PU0,0;SP0;\n";
}

Result<std::string> writeHpgl(const Pattern& pattern, const SheetSettings& settings) {
  const Result<Sheet> sheet = layOut(pattern, settings);
  if (!sheet) return sheet.error();
  return hpglOf(*sheet);
}

}  // namespace karinui
