#pragma once
// Which pieces that stand still should be drawn into a drape: neighbours of live cloth, over a seam, that would move if
// they were live.
#include <map>
#include <vector>

#include "cloth/level_solver.h"

namespace karinui {

class BoundaryActivation {
 public:
  explicit BoundaryActivation(const Cloth& cloth);
  bool empty() const { return sewnTo_.empty(); }

  // The still neighbours that would move further than `far` metres in one long step from `x`, both by the whole
  // unbalanced force and by the change of the live cloth's force on their seams alone, from `before` to `after`
  // (newtons, per node). The first alone would name cloth that only misses its friction, which no drape keeps.
  std::vector<PieceId> piecesToActivate(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                                        const std::vector<Vec3>& x, const ColliderList& colliders,
                                        const SettleSettings& settings, double far, const Token& token,
                                        Workers& workers) const;

 private:
  const Cloth& cloth_;
  std::map<std::size_t, std::vector<NodeIndex>> sewnTo_;  // live nodes, by the still piece they are sewn to
};

}  // namespace karinui
