#include "body/anthropometry/contour.h"

#include <algorithm>

namespace karinui {

void Interval::include(double v) { low = std::min(low, v), high = std::max(high, v); }

Interval widthOf(const SectionLoop& contour) {
  Interval width;
  for (const Vec3& p : contour.points) width.include(p.x);
  return width;
}

Vec3 contourCentre(const SectionLoop& contour) {
  Vec3 sum;
  double total = 0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const Vec3 a = contour.points[i], b = contour.points[(i + 1) % contour.points.size()];
    const double l = distance(a, b);
    sum += (a + b) * (l / 2);
    total += l;
  }
  return total > 0 ? sum * (1 / total) : contour.points.empty() ? Vec3{} : contour.points[0];
}

Vec3 foremost(const SectionLoop& contour) {
  return *std::max_element(contour.points.begin(), contour.points.end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
}

Vec3 outermost(const SectionLoop& contour, int side) {
  return *std::max_element(contour.points.begin(), contour.points.end(),
                           [&](Vec3 a, Vec3 b) { return side ? a.x > b.x : a.x < b.x; });
}

std::optional<SectionLoop> contourNear(const TriangleMesh& mesh, Vec3 through, Vec3 normal, Vec3 near) {
  std::optional<SectionLoop> best;
  double least = 1e9;
  for (SectionLoop& contour : section(mesh, {through, normal})) {
    const double far = distance(contourCentre(contour), near);
    if (far < least) least = far, best = std::move(contour);
  }
  return best;
}

double tapeAcross(const TriangleMesh& mesh, Vec3 place, Vec3 normal) {
  const auto contour = contourNear(mesh, place, normal, place);
  return contour ? tightTapeLength(contour->points, normal) : 0;
}

}  // namespace karinui
