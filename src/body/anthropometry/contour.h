#pragma once
// What is measured on one closed line in which a plane cuts a body. Metres. Pure functions, any thread.
#include <optional>

#include "karinui/geometry/section.h"

namespace karinui {

struct Interval {
  double low = 1e9, high = -1e9;  // empty
  void include(double v);
};
Interval widthOf(const SectionLoop& contour);          // in x
Vec3 contourCentre(const SectionLoop& contour);        // the centroid of the line, by length
Vec3 foremost(const SectionLoop& contour);             // its point of largest z
Vec3 outermost(const SectionLoop& contour, int side);  // its point farthest to the body's left (0) or right (1)

// The contour of the section whose centre is nearest to `near`; nothing if the plane misses the mesh.
std::optional<SectionLoop> contourNear(const TriangleMesh& mesh, Vec3 through, Vec3 normal, Vec3 near);
// The tight tape around the contour nearest to a place, across `normal`; 0 where there is none.
double tapeAcross(const TriangleMesh& mesh, Vec3 place, Vec3 normal);

}  // namespace karinui
