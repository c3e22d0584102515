#pragma once
// The product of the step's matrix with a vector, for the panels: stretch, shear, bending and each node's own block,
// without ever storing the matrix. About a hundred bytes and two hundred operations a node, where stored blocks take a
// thousand bytes.
#include <array>
#include <vector>

#include "cloth/panel_stretch.h"

namespace karinui {

// Arrays over slots, x y z.
using Lanes3 = std::array<std::vector<float>, 3>;

// Bending per slot, N/m: of the second difference along weft and warp, and of the twist of the cell that begins here.
struct PanelBending {
  std::vector<float> weft, warp, twist;
  explicit PanelBending(std::size_t slots) : weft(slots, 0), warp(slots, 0), twist(slots, 0) {}
};

// Each slot's own 3x3 block, symmetric: xx xy xz yy yz zz.
using OwnBlocks = std::array<std::vector<float>, 6>;

// q = A p on a part's slots; loose ones get their own block times p.
void multiplyPart(const PanelPlan& plan, const SlotPart& part, const PanelStiffness& stiffness,
                  const PanelBending& bending, const OwnBlocks& own, const Lanes3& p, Lanes3& q);
double dotOf(const SlotPart& part, const Lanes3& p, const Lanes3& q);

// Adds to the slots' own blocks what the panel's stretch, shear and bending have on the diagonal.
void addDiagonals(const PanelPlan& plan, const SlotPart& part, const PanelStiffness& stiffness,
                  const PanelBending& bending, OwnBlocks& own);

}  // namespace karinui
