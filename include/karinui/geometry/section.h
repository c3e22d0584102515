#pragma once
// A plane through a mesh, and the tape measure laid around what it cuts. Metres. Pure functions, any thread.
#include <span>
#include <vector>

#include "karinui/geometry/mesh.h"

namespace karinui {

struct Plane {
  Vec3 through;
  Vec3 normal;  // unit
};

// One line in which a plane cuts a mesh. Seen against the normal (looking down at it), the solid lies to the left of a
// closed loop: outer loops run counter-clockwise, those around a hollow clockwise.
struct SectionLoop {
  std::vector<Vec3> points;          // a closed loop does not repeat its first point
  std::vector<std::uint32_t> faces;  // faces[i] is cut from points[i] to points[i + 1]
  bool closed = true;                // false only where the mesh is open or not manifold
};

// All lines of the section, in the order of their first face. A point exactly on the plane counts as above it, so a
// closed manifold mesh always gives closed loops; a face lying in the plane gives none of its own.
std::vector<SectionLoop> section(const TriangleMesh& mesh, const Plane& plane);

double lineLength(std::span<const Vec3> points, bool closed);
// The area enclosed by the loop as seen against the normal; > 0 counter-clockwise.
double enclosedArea(std::span<const Vec3> loop, Vec3 normal);

// The corners of the convex hull, counter-clockwise, without collinear points; fewer than three for less than an area.
std::vector<Flat> convexHull(std::span<const Flat> points);

// The tight tape: convex hull of points (seen along the unit normal), counter-clockwise seen against it.
std::vector<Vec3> tightTape(std::span<const Vec3> points, Vec3 normal);
double tightTapeLength(std::span<const Vec3> points, Vec3 normal);

}  // namespace karinui
