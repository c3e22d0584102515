#include <algorithm>

#include "geometry/triangle.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/mesh.h"

namespace karinui {
namespace {

bool shareCorner(const Triangle& f, const Triangle& g) {
  return std::any_of(f.begin(), f.end(), [&](std::uint32_t i) { return i == g[0] || i == g[1] || i == g[2]; });
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> selfCrossings(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const Bvh bvh(mesh);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Corners corners = cornersOf(mesh, mesh.faces[f]);
    Box box;
    for (Vec3 p : corners) box.include(p);
    bvh.touching(box, [&](std::uint32_t g) {
      if (g <= f || shareCorner(mesh.faces[f], mesh.faces[g])) return;
      if (passThrough(corners, cornersOf(mesh, mesh.faces[g]))) pairs.push_back({f, g});
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace karinui
