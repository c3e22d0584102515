#pragma once
// The layout of the solver's arrays. Every moving node has a slot. The regular lattice of each woven piece is a grid
// block: a padded rectangle of slots in which neighbours are a fixed distance apart, so that a loop over it needs no
// indices. What does not fit (the ring, simcloth, half-covered borders) is left to unstructured matrices.
#include <array>
#include <cstdint>
#include <vector>

#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

struct GridBlock {
  std::size_t piece = 0;     // of Cloth::pieces
  std::uint32_t first = 0;   // slot of column 0, row 0
  std::uint32_t stride = 0;  // slots from row to row, a multiple of kLanes, at least two more than columns
  std::uint32_t columns = 0, rows = 0;
  double weftStep = 0, warpStep = 0;  // metres between neighbours
};

// Slots that belong to one worker in every pass of an iteration, so that what a pass leaves in a processor's cache is
// there for the next: some rows of a grid block, or unstructured slots.
struct SlotRange {
  std::uint32_t block = kNoBlock;
  std::uint32_t row = 0, rows = 0;  // of the block
  std::size_t begin = 0, end = 0;   // multiples of kLanes
  static constexpr std::uint32_t kNoBlock = static_cast<std::uint32_t>(-1);
  bool unstructured() const { return block == kNoBlock; }
};

// Triangles of whole cells have one right angle. Their weft and warp sides are threads of the block; the shear between
// them is evaluated at the right angle's node. Cells alternate their diagonals, so in a whole neighbourhood every other
// node has four right angles around it and the rest have none.
class GridLayout {
 public:
  explicit GridLayout(const Cloth& cloth);

  std::vector<GridBlock> blocks;
  std::size_t slots = 0;              // with room around for a neighbour's neighbour
  std::vector<std::uint32_t> slotOf;  // per node; kNoNode for nodes of pieces that are not live
  std::vector<SlotRange> ranges;      // all slots in which something is, in order
  // Per slot, m2: of the thread to the next slot along weft or warp, and of each of the four right angles around it (0
  // unless there are four).
  std::vector<double> weftArea, warpArea, cornerArea;
  enum class Remainder : std::uint8_t { Nothing, Shear, All };  // what of a face is left to Membrane
  std::vector<std::vector<Remainder>> remainder;                // per piece and face of its lattice
};

}  // namespace karinui
