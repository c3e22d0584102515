#pragma once
// Where the pure lattice of each woven piece lies in the solver's arrays: a padded rectangle in which neighbours are a
// fixed distance apart, so that a loop over it needs no indices. What does not fit (the ring, simcloth, half-covered
// borders) is left to the other energies.
#include <array>
#include <cstdint>
#include <vector>

#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

struct Panel {
  std::size_t piece = 0;     // of Cloth::pieces
  std::uint32_t first = 0;   // slot of column 0, row 0
  std::uint32_t stride = 0;  // slots from row to row, a multiple of kLanes, at least two more than columns
  std::uint32_t columns = 0, rows = 0;
  double weftStep = 0, warpStep = 0;  // metres between neighbours
};

// Slots that are one worker's in every job of an iteration, so that what a job leaves in a processor's cache is there
// for the next: some rows of a panel, or loose ones.
struct SlotPart {
  std::uint32_t panel = kNoPanel;
  std::uint32_t row = 0, rows = 0;  // of the panel
  std::size_t begin = 0, end = 0;   // multiples of kLanes
  static constexpr std::uint32_t kNoPanel = static_cast<std::uint32_t>(-1);
  bool loose() const { return panel == kNoPanel; }
};

// Triangles of whole cells have one right angle. Their weft and warp sides are threads of the panel; the shear between
// those is felt at the right angle's node. Grid squares alternate their diagonals, so every other node of a whole
// neighbourhood has four right angles around it and the rest have none.
class PanelPlan {
 public:
  explicit PanelPlan(const Cloth& cloth);

  std::vector<Panel> panels;
  std::size_t slots = 0;              // with room around for a neighbour's neighbour
  std::vector<std::uint32_t> slotOf;  // per node; kNoNode for nodes of pieces that are not live
  std::vector<SlotPart> parts;        // all slots in which something is, in order
  // Per slot, m2: of the thread to the next slot along weft or warp, and of each of the four right angles around it (0
  // unless there are four).
  std::vector<double> weftArea, warpArea, cornerArea;
  enum class Left : std::uint8_t { Nothing, Shear, All };  // what of a face is not in here
  std::vector<std::vector<Left>> left;                     // per piece and face of its lattice
};

}  // namespace karinui
