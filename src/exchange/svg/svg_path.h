#pragma once
// The geometry of a drawing's elements: transforms, path data, shapes, lengths with units (SVG 1.1, chapters 4, 7, 8,
// 9). Numbers are bounded and counted; what is no path is nothing.
#include <optional>
#include <string_view>
#include <vector>

#include "exchange/xml.h"
#include "karinui/geometry/curve.h"

namespace karinui {

struct SvgMatrix {  // (x, y) -> (a x + c y + e, b x + d y + f)
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Flat operator()(Flat p) const { return {a * p.u + c * p.v + e, b * p.u + d * p.v + f}; }
};
SvgMatrix operator*(const SvgMatrix& outer, const SvgMatrix& inner);  // inner first
std::optional<SvgMatrix> svgTransform(std::string_view text);

// Numbers between white space and commas, "1.5-2" and ".5.5" being two each.
std::optional<std::vector<double>> svgNumbers(std::string_view text);

// "21cm" -> 210; bare numbers and px are pixels of so many mm. Nothing: a share, or no length.
std::optional<double> svgMillimetres(std::string_view text, double pixel = 25.4 / 96);

struct SvgLine {
  std::vector<Curve> curves;
  bool closed = false;
};
// The lines of a path, rect, circle, ellipse, line, polyline or polygon, carried by the transform (whose v points
// upwards already). Nothing: it is none of these, or damaged. `budget`: how many curves may still be made.
std::optional<std::vector<SvgLine>> svgLines(const XmlElement& element, const SvgMatrix& to, std::size_t& budget);

}  // namespace karinui
