#include <algorithm>

#include "geometry/bvh_build.h"
#include "karinui/geometry/mesh.h"

namespace karinui {
namespace {

bool shareCorner(const Triangle& f, const Triangle& g) {
  return std::any_of(f.begin(), f.end(), [&](std::uint32_t i) { return i == g[0] || i == g[1] || i == g[2]; });
}

double volumeOf(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> selfCrossings(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const BvhArrays tree = buildBvh(mesh);
  if (tree.nodes.empty()) return pairs;
  std::vector<Box> boxes(tree.faces.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (const Vec3 p : tree.faces[k].corners) boxes[k].include(p);
  const auto look = [&](std::uint32_t k, std::uint32_t l) {
    if (!meet(boxes[k], boxes[l])) return;
    const std::uint32_t f = std::min(tree.faces[k].face, tree.faces[l].face),
                        g = std::max(tree.faces[k].face, tree.faces[l].face);
    if (shareCorner(mesh.faces[f], mesh.faces[g])) return;
    if (passThrough(cornersOf(mesh, mesh.faces[f]), cornersOf(mesh, mesh.faces[g]))) pairs.push_back({f, g});
  };
  // The tree against itself, each pair of branches once: a search for every face would go down it all the way each
  // time.
  std::vector<std::array<std::uint32_t, 2>> open{{0, 0}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const BvhNode &one = tree.nodes[a], &other = tree.nodes[b];
    if (a != b && !meet(one.box, other.box)) continue;
    if (one.leaf() && other.leaf()) {
      for (std::uint32_t k = one.first; k < one.first + one.count; ++k)
        for (std::uint32_t l = a == b ? k + 1 : other.first; l < other.first + other.count; ++l) look(k, l);
    } else if (a == b) {
      open.insert(open.end(), {{a + 1, a + 1}, {one.first, one.first}, {a + 1, one.first}});
    } else if (other.leaf() || (!one.leaf() && volumeOf(one.box) > volumeOf(other.box))) {
      open.insert(open.end(), {{a + 1, b}, {one.first, b}});
    } else {
      open.insert(open.end(), {{a, b + 1}, {a, other.first}});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace karinui
