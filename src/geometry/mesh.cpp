#include "karinui/geometry/mesh.h"

#include <algorithm>
#include <numeric>

#include "geometry/face_sides.h"
#include "karinui/base/result.h"

namespace karinui {
namespace {

Vec3 areaNormal(const TriangleMesh& mesh, const Triangle& f) {
  const Vec3 a = mesh.points[f[0]];
  return cross(mesh.points[f[1]] - a, mesh.points[f[2]] - a);
}

double angleBetween(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

// Which things are joined, however indirectly.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count), groups_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --groups_;
  }
  std::size_t count() const { return groups_; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
  std::size_t groups_;
};

}  // namespace

Vec3 at(const TriangleMesh& mesh, const SurfacePoint& place) {
  KARINUI_ASSERT(place.face < mesh.faces.size());
  const Triangle& f = mesh.faces[place.face];
  return mesh.points[f[0]] * place.weight[0] + mesh.points[f[1]] * place.weight[1] +
         mesh.points[f[2]] * place.weight[2];
}

Vec3 faceNormal(const TriangleMesh& mesh, std::uint32_t face) {
  KARINUI_ASSERT(face < mesh.faces.size());
  return normalized(areaNormal(mesh, mesh.faces[face]));
}

std::vector<Vec3> pointNormals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const Triangle& f : mesh.faces) {
    const Vec3 n = normalized(areaNormal(mesh, f));
    for (int k = 0; k < 3; ++k) {
      const Vec3 here = mesh.points[f[k]];
      normals[f[k]] += n * angleBetween(mesh.points[f[(k + 1) % 3]] - here, mesh.points[f[(k + 2) % 3]] - here);
    }
  }
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

double volume(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return 0;
  // Measured from a point of the mesh itself, so that a body far from the origin keeps its digits.
  const Vec3 origin = mesh.points[mesh.faces[0][0]];
  double six = 0;
  for (const Triangle& f : mesh.faces)
    six += dot(mesh.points[f[0]] - origin, cross(mesh.points[f[1]] - origin, mesh.points[f[2]] - origin));
  return six / 6;
}

double area(const TriangleMesh& mesh) {
  double twice = 0;
  for (const Triangle& f : mesh.faces) twice += length(areaNormal(mesh, f));
  return twice / 2;
}

MeshReport inspectTopology(const TriangleMesh& mesh) {
  MeshReport report;
  report.triangles = mesh.faces.size();
  report.points = mesh.points.size();
  const std::vector<FaceSide> sides = sidesByEdge(mesh);
  Groups shells(mesh.faces.size());
  for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
    end = begin + 1;
    while (end < sides.size() && sides[end].sameEdge(sides[begin])) {
      shells.join(sides[begin].face, sides[end].face);
      ++end;
    }
    const std::size_t meeting = end - begin;
    if (meeting == 1) ++report.openEdges;
    if (meeting > 2) ++report.nonManifoldEdges;
    if (meeting == 2 && sides[begin].forward == sides[begin + 1].forward) ++report.flippedEdges;
  }
  report.shells = shells.count();
  report.outward = volume(mesh) > 0;
  return report;
}

MeshReport inspect(const TriangleMesh& mesh) {
  MeshReport report = inspectTopology(mesh);
  report.selfCrossings = selfCrossings(mesh).size();
  return report;
}

}  // namespace karinui
