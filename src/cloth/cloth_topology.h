#pragma once
// Which nodes, edges and faces of a cloth are incident to each other, on one piece or over a seam, and which pairs of
// nodes are therefore never in contact. Fixed as long as the cloth is.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// Lists of numbers, one list a key, in one array.
struct Incidence {
  std::vector<std::uint32_t> start, item;
  std::span<const std::uint32_t> of(std::uint32_t key) const {
    return {item.data() + start[key], item.data() + start[key + 1]};
  }
  bool any(std::uint32_t key) const { return start[key] < start[key + 1]; }
  bool has(std::uint32_t key, std::uint32_t value) const {  // where the key's list is sorted
    return std::binary_search(item.begin() + start[key], item.begin() + start[key + 1], value);
  }
};
using KeyValue = std::pair<std::uint32_t, std::uint32_t>;
Incidence incidenceOf(std::size_t keys, const std::vector<KeyValue>& items);  // each list in the order of the items

class ClothTopology {
 public:
  // `radius`: of contact, metres. Nodes that are nearer than some radii on paper are not in contact either.
  ClothTopology(const Cloth& cloth, double radius);

  std::vector<Triangle> faces;
  std::vector<std::array<NodeIndex, 2>> edges;
  Incidence facesOf, edgesOf;        // of each node
  std::vector<std::uint32_t> piece;  // per node,
  std::vector<int> layer;            // that of its piece,
  std::vector<Flat> paper;           // and where it is on paper,
  std::vector<std::uint8_t> live;    // and whether its piece is
  // Opposite sides of the parallelogram that two faces make over the edge m n: the edges {a, m} and {b, n}, a and b
  // being the far corners, in the order of m. Those of a node m from sidesOf[m] to before sidesOf[m + 1].
  std::vector<std::array<NodeIndex, 4>> oppositeSides;
  std::vector<std::uint32_t> sidesOf;

  // Partners at a seam that are one point, tied already or not.
  bool sewn(NodeIndex a, NodeIndex b) const { return seam_[a] == seam_[b]; }
  // Never in contact: partners, also of a pair sewn 2:1, ends of an edge, corners across an edge of a narrow band.
  bool neighbours(NodeIndex a, NodeIndex b) const { return sewn(a, b) || near_.has(a, b); }
  bool isFace(NodeIndex a, NodeIndex b, NodeIndex c) const {
    const auto own = facesOf.of(a);
    return std::any_of(own.begin(), own.end(), [&](std::uint32_t f) {
      const auto corner = [&](NodeIndex k) { return faces[f][0] == k || faces[f][1] == k || faces[f][2] == k; };
      return corner(b) && corner(c);
    });
  }
  // Beside each other over a seam: in contact only where the seam is folded.
  bool overSeam(NodeIndex a, NodeIndex b) const { return over_.any(a) && over_.has(a, b); }

 private:
  void sortOppositeSides();

  std::vector<std::uint32_t> seam_;  // seam partners share a number
  Incidence near_, over_;
};

// Each node's neighbours by the edges of the faces, over the seams too; sorted.
std::vector<std::vector<std::uint32_t>> neighboursOf(const Cloth& cloth);

}  // namespace karinui
