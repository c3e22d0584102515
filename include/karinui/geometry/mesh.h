#pragma once
// A triangle mesh in space: the body, a scan, a piece of cloth as a shape. Plain data; faces are counter-clockwise seen
// from outside. Metres. Pure functions, any thread; faces and places that name a point or face that is not there are
// the caller's fault (readers check a stranger's mesh first).
#include <array>
#include <cstdint>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/geometry/vec.h"

namespace karinui {

using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> faces;
};

// A place on a mesh: a face and weights of its three corners (sum 1).
struct SurfacePoint {
  std::uint32_t face = 0;
  std::array<double, 3> weight{1, 0, 0};
};
Vec3 at(const TriangleMesh& mesh, const SurfacePoint& place);
Vec3 faceNormal(const TriangleMesh& mesh, std::uint32_t face);  // unit; zero for a degenerate face
std::vector<Vec3> pointNormals(const TriangleMesh& mesh);       // angle-weighted, unit
double volume(const TriangleMesh& mesh);                        // cubic metres; > 0 when a closed mesh faces outward
double area(const TriangleMesh& mesh);                          // square metres

// What is wrong with a mesh, in numbers a person can be told.
struct MeshReport {
  std::size_t triangles = 0, points = 0;
  std::size_t shells = 0;            // connected parts
  std::size_t openEdges = 0;         // edges with one face: holes
  std::size_t nonManifoldEdges = 0;  // edges with three or more faces
  std::size_t flippedEdges = 0;      // edges whose two faces disagree on which side is out
  std::size_t selfCrossings = 0;     // pairs of faces that cross and share no corner
  bool outward = true;               // signed volume > 0
  bool closed() const { return triangles > 0 && openEdges == 0 && nonManifoldEdges == 0 && flippedEdges == 0; }
};
MeshReport inspect(const TriangleMesh& mesh);
MeshReport inspectTopology(const TriangleMesh& mesh);  // the same without selfCrossings (0), much cheaper

// All pairs (a < b) of faces of one mesh that share no corner and pass through each other: each has corners strictly on
// both sides of the other's plane, and they share a segment. Faces that only touch do not cross. Exact whatever the
// rounding (orientation predicates of Shewchuk 1997). In ascending order.
std::vector<std::array<std::uint32_t, 2>> selfCrossings(const TriangleMesh& mesh);

}  // namespace karinui
