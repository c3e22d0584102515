#pragma once
// The product of the step's matrix with a vector, for the grid blocks, matrix-free: stretch, shear, bending and each
// node's diagonal block. About a hundred bytes and two hundred operations a node, where stored blocks take a
// thousand bytes.
#include <array>
#include <vector>

#include "cloth/grid_membrane.h"

namespace karinui {

// Arrays over slots, x y z.
using SlotVectors = std::array<std::vector<float>, 3>;

// Bending per slot, N/m: of the second difference along weft and warp, and of the twist of the cell that begins here.
struct GridBending {
  std::vector<float> weft, warp, twist;
  explicit GridBending(std::size_t slots) : weft(slots, 0), warp(slots, 0), twist(slots, 0) {}
};

// Each slot's 3x3 block of the diagonal, symmetric: xx xy xz yy yz zz.
using DiagonalBlocks = std::array<std::vector<float>, 6>;

// q = A p on a range's slots; unstructured ones get their diagonal block times p.
void multiplyRange(const GridLayout& layout, const SlotRange& range, const GridStiffness& stiffness,
                   const GridBending& bending, const DiagonalBlocks& diagonal, const SlotVectors& p, SlotVectors& q);
double dotOf(const SlotRange& range, const SlotVectors& p, const SlotVectors& q);

// Adds the diagonal of a grid block's stretch, shear and bending.
void addDiagonals(const GridLayout& layout, const SlotRange& range, const GridStiffness& stiffness,
                  const GridBending& bending, DiagonalBlocks& diagonal);

}  // namespace karinui
