#include <cmath>

#include "karinui/pattern/piece.h"

namespace karinui {
namespace {

// The area between a curve and the two rays from `about` to its ends: half the integral of P x dP, in closed form.
double swept(const Curve& curve, Flat about) {
  const Flat a = curve.start - about, b = curve.end - about;
  switch (curve.kind) {
    case Curve::Kind::Line:
      return cross(a, b) / 2;
    case Curve::Kind::Cubic: {
      const Flat c = curve.control1 - about, d = curve.control2 - about;
      return (6 * cross(a, c) + 3 * cross(a, d) + cross(a, b) + 3 * cross(c, d) + 3 * cross(c, b) + 6 * cross(d, b)) /
             20;
    }
    case Curve::Kind::Arc: {
      const double angle = 4 * std::atan(curve.bulge);
      const double chord = distance(a, b);
      // Circular segment: r^2 (angle - sin angle) / 2 with r = chord / (2 sin(angle / 2)); its series when it is flat.
      const double half = angle / 2;
      const double segment = std::abs(angle) < 1e-4
                                 ? chord * chord * angle / 12
                                 : chord * chord * (angle - std::sin(angle)) / (8 * std::sin(half) * std::sin(half));
      return cross(a, b) / 2 + segment;
    }
  }
  return 0;
}

}  // namespace

double Outline::length() const {
  double sum = 0;
  for (const Edge& edge : edges) sum += edge.curve.length();
  return sum;
}

double Outline::area() const {
  double sum = 0;
  for (const Edge& edge : edges)
    for (const Curve& part : edge.curve.parts()) sum += swept(part, edges.front().curve.start);
  return sum;
}

Ring Outline::flattened(double miss) const {
  Ring ring;
  for (const Edge& edge : edges) {
    const auto points = edge.curve.flattened(miss);
    ring.insert(ring.end(), points.begin(), points.end() - 1);
  }
  return ring;
}

std::optional<std::size_t> Outline::find(std::string_view edgeName) const {
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (edges[k].name == edgeName) return k;
  return std::nullopt;
}

}  // namespace karinui
