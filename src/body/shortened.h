#pragma once
// A figure whose ends are taken off along planes. Metres.
#include <cstdint>
#include <map>
#include <vector>

#include "karinui/geometry/section.h"

namespace karinui {

inline double along(const Plane& plane, Vec3 p) { return dot(p - plane.through, plane.normal); }

using Line = std::vector<std::uint32_t>;  // a closed line of points

// The edges, each from its first point to the next, as one closed line; empty where they are none, or more than one.
Line oneLine(const std::map<std::uint32_t, std::uint32_t>& next);

// Points and faces that are left keep their place and their order; those new at a cut come after them. A point of the
// skin that lies nearly on a cut is where the cut passes, so that there are no slivers. Refers to the mesh.
class Shortened {
 public:
  explicit Shortened(const TriangleMesh& mesh);

  // What hangs together with the point nearest to `tip` beyond the plane goes. The cut's line, the skin to its left;
  // empty where it is none, or more than one.
  Line takeOff(const Plane& cut, Vec3 tip);
  // The rest; points that are left over belong to no face.
  TriangleMesh taken() const;

 private:
  Vec3 point(std::uint32_t i) const;
  double height(const Plane& cut, std::uint32_t point) const;
  std::vector<std::uint32_t> facesBeyond(const Plane& cut, Vec3 tip) const;  // those it cuts among them

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> first_, faceOf_;  // the faces around each point
  std::vector<bool> gone_;
  std::vector<Vec3> points_;
  std::vector<Triangle> faces_;
};

// Joins two open lines of a mesh that face each other by a strip, each with its faces to the left: both are gone along
// together, by their angle about the normal, so that the strip does not twist. False: one is no ring about it.
bool joinLines(TriangleMesh& mesh, const Line& a, Line b, Vec3 normal);

// Without the points no face has.
TriangleMesh compact(const TriangleMesh& mesh);

}  // namespace karinui
