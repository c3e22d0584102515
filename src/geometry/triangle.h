#pragma once
// One triangle in space: its nearest point, its solid angle, and whether it passes through another.
#include <array>

#include "karinui/geometry/mesh.h"

namespace karinui {

using Corners = std::array<Vec3, 3>;
inline Corners cornersOf(const TriangleMesh& mesh, const Triangle& face) {
  return {mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]};
}

// The weights (sum 1, all >= 0) of the triangle's point nearest to a place. Right for degenerate triangles too.
std::array<double, 3> nearestWeights(const Corners& triangle, Vec3 from);

// The signed solid angle in steradians; > 0 when the place is behind the face (inside).
// Source: A. Van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solidAngle(const Corners& triangle, Vec3 from);

// Whether two triangles pass through each other: each has corners strictly on both sides of the other's plane, and they
// share a segment of some length. Exact.
// Source: P. Guigue and O. Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates",
// 2003.
bool passThrough(Corners one, Corners other);

}  // namespace karinui
