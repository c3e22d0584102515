#pragma once
// Lumped areas: the part of a lattice's area that belongs to each node, in whole cells and in the ring apart; and the
// lattice's stencils.
#include <array>
#include <cstdint>
#include <vector>

#include "karinui/pattern/lattice.h"

namespace karinui {

struct LatticeAreas {
  std::vector<double> cell, ring;                     // m2 per node; their sum over all nodes is the area
  std::vector<std::array<std::uint32_t, 4>> corners;  // of each whole cell: (i,j) (i+1,j) (i,j+1) (i+1,j+1)
  // The node's four neighbours -weft, +weft, -warp, +warp when all four cells around it are whole; else kNoNode.
  std::vector<std::array<std::uint32_t, 4>> stencil;
  std::vector<std::uint32_t> ringFaces;  // those that have an area and lie in no whole cell
};
LatticeAreas latticeAreas(const Lattice& lattice);

// Each node's neighbours by the edges of the faces, sorted.
std::vector<std::vector<std::uint32_t>> neighboursOf(std::size_t nodes, const std::vector<Triangle>& faces);

}  // namespace karinui
