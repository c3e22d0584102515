// The sheet as SVG 1.1. Numbers carry six decimals of a millimetre: a curve read back is the same to a nanometre.
#include "fabric_values.h"
#include "karinui/base/number.h"
#include "names.h"
#include "sheet.h"
#include "strict_json.h"

namespace karinui {
namespace {

std::string number(double value) {
  std::string out = fixed(value, 6);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  return out;
}
std::string pair(Mm p) { return number(p.x) + " " + number(p.y); }
std::string pair(Flat p) { return shortest(p.u) + " " + shortest(p.v); }

std::string pathTo(const SheetPiece& piece, const Curve& curve) {
  const std::string end = pair(piece.at(curve.end));
  if (curve.kind == Curve::Kind::Cubic) {
    std::string all;
    for (const Curve& c : curve.parts())
      all += (all.empty() ? "C " : " C ") + pair(piece.at(c.control1)) + " " + pair(piece.at(c.control2)) + " " +
             pair(piece.at(c.end));
    return all;
  }
  if (curve.kind == Curve::Kind::Arc && std::abs(curve.bulge) > 1e-9) {
    const double quarter = std::atan(std::abs(curve.bulge));
    const std::string radius = fixed(distance(curve.start, curve.end) * 1000 / (2 * std::sin(2 * quarter)), 9);
    // y points down here: what turns left on paper turns against SVG's positive sweep.
    return "A " + radius + " " + radius + " 0 " + (std::abs(curve.bulge) > 1 ? "1 " : "0 ") +
           (curve.bulge > 0 ? "0 " : "1 ") + end;
  }
  return "L " + end;
}

void outline(std::string& out, const SheetPiece& piece, const Outline& ring, const char* kind, std::size_t index,
             const std::string& id) {
  std::map<std::string, std::size_t> parts;  // of half a piece an edge may have several
  for (const Edge& edge : ring.edges) {
    const std::size_t part = ++parts[edge.name];
    out += "    <path id=\"" + id + xmlEscaped(edge.name) + (part > 1 ? "." + std::to_string(part) : "") +
           "\" class=\"" + kind + "\" data-edge=\"" + xmlEscaped(edge.name) + "\"";
    if (std::string_view(kind) == "hole") out += " data-hole=\"" + std::to_string(index) + "\"";
    if (const auto own = piece.allowances.find(edge.name); own != piece.allowances.end())
      out += " data-allowance=\"" + number(own->second) + "\"";
    out += " d=\"M " + pair(piece.at(edge.curve.start)) + " " + pathTo(piece, edge.curve) + "\"/>\n";
  }
}

void words(std::string& out, const SheetText& text, const char* kind) {
  out += std::string("    <text class=\"") + kind + "\" x=\"" + number(text.place.x) + "\" y=\"" +
         number(text.place.y) + "\" font-size=\"" + number(text.size) + "\"";
  if (!text.upright) out += " transform=\"rotate(-90 " + pair(text.place) + ")\"";
  out += " dy=\"0.35em\">" + xmlEscaped(text.words) + "</text>\n";
}

void stroke(std::string& out, const char* kind, Mm from, Mm to, const std::string& more = {}) {
  out += std::string("    <path class=\"") + kind + "\"" + more + " d=\"M " + pair(from) + " L " + pair(to) + "\"/>\n";
}

void piece(std::string& out, const SheetPiece& drawn, std::size_t index) {
  const Piece& p = *drawn.piece;
  const std::string name = xmlEscaped(p.name);
  out += "  <g id=\"piece-" + std::to_string(index) + "\" class=\"" + (drawn.strip ? "strip" : "piece") +
         "\" data-piece=\"" + name + "\" data-id=\"" + std::to_string(p.id.value) + "\" data-fabric=\"" +
         xmlEscaped(p.fabric) + "\" data-grain=\"" + pair(p.grain) + "\" data-layer=\"" + std::to_string(p.layer) +
         "\" data-origin=\"" + pair(drawn.origin) + "\">\n    <title>" + name + "</title>\n";
  const std::string edges = "piece-" + std::to_string(index) + "-";
  for (const auto& line : drawn.cutLines) {
    out += "    <path class=\"cut\" d=\"M " + pair(line[0]);
    for (std::size_t i = 1; i < line.size(); ++i) out += " L " + pair(line[i]);
    out += " Z\"/>\n";
  }
  for (const SheetSize& size : drawn.nest) {
    std::string dashes;
    for (const double dash : dashesOf(size.size)) dashes += (dashes.empty() ? "" : " ") + number(dash);
    out += "    <path class=\"size\" data-size=\"" + xmlEscaped(size.name.words) +
           "\" style=\"stroke-dasharray: " + dashes + "\" d=\"M " + pair(size.line[0]);
    for (std::size_t i = 1; i < size.line.size(); ++i) out += " L " + pair(size.line[i]);
    out += " Z\"/>\n";
    words(out, size.name, "size-name");
  }
  outline(out, drawn, p.outline, drawn.cutLines.empty() ? "seam only" : "seam", 0, edges);
  for (std::size_t i = 0; i < p.holes.size(); ++i) outline(out, drawn, p.holes[i], "hole", i, edges);
  for (const InternalLine& line : p.lines) {
    if (line.curves.empty()) continue;
    out += "    <path class=\"internal\" data-line=\"" + xmlEscaped(line.name) + "\" d=\"";
    for (std::size_t i = 0; i < line.curves.size(); ++i) {
      if (i == 0 || line.curves[i].start != line.curves[i - 1].end)
        out += (i == 0 ? "M " : " M ") + pair(drawn.at(line.curves[i].start));
      out += " " + pathTo(drawn, line.curves[i]);
    }
    out += "\"/>\n";
  }
  for (const SheetStitches& row : drawn.stitches) {
    out += "    <path class=\"topstitch\" style=\"stroke-dasharray: " + number(row.dashes()[0]) + " " +
           number(row.dashes()[1]) + "\" d=\"M " + pair(row.line[0]);
    for (std::size_t i = 1; i < row.line.size(); ++i) out += " L " + pair(row.line[i]);
    out += "\"/>\n";
  }
  for (const std::vector<Mm>& trim : drawn.trims) {
    out += "    <path class=\"trim\" d=\"M " + pair(trim[0]);
    for (std::size_t i = 1; i < trim.size(); ++i) out += " L " + pair(trim[i]);
    out += "\"/>\n";
  }
  for (const SheetNotch& notch : drawn.notches)
    stroke(out, "notch", notch.stroke.from, notch.stroke.to, " data-seam=\"" + xmlEscaped(notch.seam) + "\"");
  for (const Mm place : drawn.drills) {
    out += "    <circle class=\"drill\" cx=\"" + number(place.x) + "\" cy=\"" + number(place.y) + "\" r=\"" +
           number(kDrillRadius * 1000) + "\"/>\n";
    for (const Mm arm : {Mm{kDrillArm * 1000, 0}, Mm{0, kDrillArm * 1000}})
      stroke(out, "drill", place - arm, place + arm);
  }
  for (const Mark& mark : p.marks) {
    out += "    <metadata class=\"mark\" data-mark=\"" + xmlEscaped(mark.name) + "\"";
    if (mark.edge.empty())
      out += " data-place=\"" + pair(mark.place) + "\"/>\n";
    else
      out += " data-edge=\"" + xmlEscaped(mark.edge) + "\" data-fraction=\"" + shortest(mark.fraction) + "\"/>\n";
  }
  if (drawn.grain) stroke(out, "grain", drawn.grain->from, drawn.grain->to);
  for (const std::vector<Mm>& fold : drawn.folds) {
    out += "    <path class=\"grain fold\" d=\"M " + pair(fold[0]);
    for (std::size_t i = 1; i < fold.size(); ++i) out += " L " + pair(fold[i]);
    out += "\"/>\n";
  }
  for (std::size_t i = 0; i < drawn.texts.size(); ++i)
    words(out, drawn.texts[i], i == 0 ? "name" : i == 1 ? "cut-count" : i < drawn.labels ? "made-for" : "beside");
  out += "  </g>\n";
}

std::string spans(const std::vector<EdgeSpan>& side) {
  std::string out;
  for (const EdgeSpan& span : side)
    out += (out.empty() ? "" : " ") + std::to_string(span.piece.value) + "." + span.edge + "@" + shortest(span.from) +
           ".." + shortest(span.to);
  return out;
}

constexpr const char* kStyle =
    "  <style>\n"
    "    path, circle, rect { fill: none; stroke: #000; stroke-width: 0.35; stroke-linecap: round; stroke-linejoin: "
    "round }\n"
    "    .cut { stroke-width: 0.6 } .seam, .hole { stroke-dasharray: 5 2 } .only { stroke-width: 0.6; "
    "stroke-dasharray: none }\n"
    "    .internal { stroke-dasharray: 1 2; stroke: #333 } .notch { stroke-width: 0.7 } .topstitch { stroke-width: "
    "0.3; stroke: #06c }\n"
    "    .trim { stroke-dasharray: 6 1.5 0.5 1.5; stroke-width: 0.3; stroke: #06c }\n"
    "    .grain { stroke-width: 0.5; marker-start: url(#tail); marker-end: url(#head) }\n"
    "    text { font-family: 'IPAPGothic', 'Noto Sans CJK JP', 'DejaVu Sans', sans-serif; text-anchor: middle; fill: "
    "#000 }\n"
    "    .heading { text-anchor: start } .beside { fill: #333 }\n"
    "  </style>\n"
    "  <defs>\n"
    "    <marker id=\"head\" markerUnits=\"userSpaceOnUse\" markerWidth=\"9\" markerHeight=\"6\" refX=\"8\" refY=\"3\" "
    "orient=\"auto\">"
    "<path d=\"M 0 0 L 8 3 L 0 6 z\" style=\"fill:#000;stroke:none\"/></marker>\n"
    "    <marker id=\"tail\" markerUnits=\"userSpaceOnUse\" markerWidth=\"9\" markerHeight=\"6\" refX=\"1\" refY=\"3\" "
    "orient=\"auto\">"
    "<path d=\"M 9 0 L 1 3 L 9 6 z\" style=\"fill:#000;stroke:none\"/></marker>\n"
    "  </defs>\n";

}  // namespace

std::string svgOf(const Sheet& sheet, const Pattern* sewing) {
  const std::string width = number(sheet.width), height = number(sheet.height);
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"" +
      width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height + "\" data-format=\"" +
      (sewing ? "karinui-sheet-1" : "karinui-lay-1") + "\">\n  <title>" + xmlEscaped(sheet.title) + "</title>\n" +
      kStyle;
  // White paper, also where a viewer is dark.
  out += "  <rect id=\"paper\" x=\"0\" y=\"0\" width=\"" + width + "\" height=\"" + height +
         "\" style=\"fill:#fff;stroke:none\"/>\n";
  out += "  <g id=\"test-square\">\n    <rect x=\"" + number(sheet.square.x) + "\" y=\"" + number(sheet.square.y) +
         "\" width=\"100\" height=\"100\"/>\n";
  words(out, {sheet.square + Mm{kSquare / 2, kSquare / 2}, 6, true, "100 × 100 mm"}, "square");
  for (const SheetText& heading : sheet.headings) words(out, heading, "heading");
  out += "  </g>\n";
  for (const std::vector<Mm>& border : sheet.borders) {
    out += "  <path class=\"cloth\" d=\"M " + pair(border[0]);
    for (std::size_t i = 1; i < border.size(); ++i) out += " L " + pair(border[i]);
    out += "\"/>\n";
  }
  for (std::size_t i = 0; i < sheet.pieces.size(); ++i) piece(out, sheet.pieces[i], i + 1);
  if (sewing)
    for (const auto& [id, seam] : sewing->seams)
      out += "  <metadata id=\"seam-" + std::to_string(id.value) + "\" class=\"sewing\" data-seam=\"" +
             xmlEscaped(seam.name) + "\" data-id=\"" + std::to_string(id.value) + "\" data-a=\"" + spans(seam.a) +
             "\" data-b=\"" + spans(seam.b) + "\" data-reversed=\"" + (seam.reversed ? "1" : "0") + "\" data-tie=\"" +
             std::string(tieName(seam.tie)) + "\"/>\n";
  return out + "</svg>\n";
}

Result<std::string> writeSvg(const Pattern& pattern, const SheetSettings& settings) {
  const Result<Sheet> sheet = layOut(pattern, settings);
  if (!sheet) return sheet.error();
  std::string told;
  for (const Fabric* fabric : fabricsOf(pattern, settings.fabrics)) {
    told += "  <metadata class=\"fabric\" data-name=\"" + xmlEscaped(fabric->name) + "\" data-law=\"" +
            std::string(lawName(fabric->law)) + "\"";
    eachFabricValue(*fabric, [&](const char* name, double value) {
      told += std::string(" data-") + name + "=\"" + shortest(value) + "\"";
    });
    told += "/>\n";
  }
  std::string drawn = svgOf(*sheet, &pattern);
  return drawn.insert(drawn.rfind("</svg>"), told);
}

}  // namespace karinui
