#pragma once
// The tree of boxes itself: a flat array in depth-first order, split by the surface area heuristic. Private to Bvh.
#include <cstdint>
#include <vector>

#include "geometry/triangle.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

inline bool meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

struct BvhNode {
  Box box;
  std::uint32_t first = 0;  // leaf: its first face in leaf order; else: the right child (the left one follows the node)
  std::uint32_t count = 0;  // leaf: how many faces; else 0
  bool leaf() const { return count > 0; }
};

// What a node looks like from far away: all its area at one place.
struct BvhDipole {
  Vec3 centre;        // mean of the faces' middles, weighted by area
  Vec3 areaNormal;    // sum of area times normal
  double radius = 0;  // every face of the node lies within it
};

struct BvhFace {
  Corners corners;
  std::uint32_t face = 0;
};

// No branch of the tree is longer, whatever the mesh: the splitting turns to plain halving in time.
constexpr std::size_t kBvhDeepest = 96;

struct BvhArrays {
  std::vector<BvhNode> nodes;  // empty for an empty mesh, else nodes[0] is the root
  std::vector<BvhDipole> dipoles;
  std::vector<BvhFace> faces;  // in leaf order
};
BvhArrays buildBvh(const TriangleMesh& mesh);

}  // namespace karinui
