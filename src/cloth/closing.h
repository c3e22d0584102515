#pragma once
// Draws open seams together: a pull of limited strength between partners, which goes round the body where the straight
// way leads into it.
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/block_system.h"
#include "cloth/body_contact.h"

namespace karinui {

struct ClosingPull {
  Tie tie;
  Vec3 onA, onB;         // newtons; onB is shared by b and c
  double stiffness = 0;  // N/m
};
// For the ties not yet tied. `firmness`: 1 to begin with; more where something holds a seam open.
std::vector<ClosingPull> closingPulls(const Cloth& cloth, const std::vector<std::uint8_t>& tied,
                                      std::span<const Vec3> x, const BodyContact& contact, double firmness);
void addGradient(const std::vector<ClosingPull>& pulls, std::span<Vec3> gradient);
void addCouplings(const std::vector<ClosingPull>& pulls, const TieMap& ties, std::vector<Coupling>& couplings);

}  // namespace karinui
