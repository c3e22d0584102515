#pragma once
// What part of a lattice's area belongs to each node, split by whether it lies in whole cells or in the ring.
#include <array>
#include <cstdint>
#include <vector>

#include "karinui/pattern/lattice.h"

namespace karinui {

struct LatticeShares {
  std::vector<double> cell, ring;                     // m2 per node; their sum over all nodes is the area
  std::vector<std::array<std::uint32_t, 4>> corners;  // of each whole cell: (i,j) (i+1,j) (i,j+1) (i+1,j+1)
  // The node's four neighbours -weft, +weft, -warp, +warp when all four cells around it are whole; else kNoNode.
  std::vector<std::array<std::uint32_t, 4>> cross;
  std::vector<std::uint32_t> ringFaces;  // those that have an area and lie in no whole cell
};
LatticeShares sharesOf(const Lattice& lattice);

// Each node's neighbours by the edges of the faces, sorted.
std::vector<std::vector<std::uint32_t>> neighboursOf(std::size_t nodes, const std::vector<Triangle>& faces);

}  // namespace karinui
