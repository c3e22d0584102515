#pragma once
// Where live cloth is sewn to pieces that stand still, and whether these would give way: the edge of what is draped
// goes on there.
#include <map>
#include <vector>

#include "cloth/level_solver.h"

namespace karinui {

class Rim {
 public:
  explicit Rim(const Cloth& cloth);
  bool empty() const { return sewnTo_.empty(); }

  // The pieces that stand still and would go further than `far` metres in one long step from `x`, were they live; and
  // not for their own sake (friction is forgotten at rest), but as far as that also if they felt nothing else than how
  // the live cloth's pull at their seams changed from `before` to `after` (newtons, per node of the cloth).
  std::vector<PieceId> stirred(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                               const std::vector<Vec3>& x, const ColliderList& colliders,
                               const SettleSettings& settings, double far, const Token& token, Workers& workers) const;

 private:
  const Cloth& cloth_;
  std::map<std::size_t, std::vector<NodeIndex>> sewnTo_;  // the live nodes, by the piece they are sewn to
};

}  // namespace karinui
