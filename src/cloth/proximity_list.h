#pragma once
// Pairs of nodes near each other that may be in contact (a Verlet list). It is made wider than asked and serves until
// others may have come nearer to each other by the margin.
#include <array>
#include <span>
#include <vector>

#include "cloth/approach_bound.h"
#include "cloth/cloth_topology.h"
#include "cloth/sewn_groups.h"
#include "karinui/base/workers.h"

namespace karinui {

class ProximityList {
 public:
  // All three must outlive this. `spacing`: of the cloth, metres.
  ProximityList(const ClothTopology& topology, const SewnGroups& sewn, double spacing)
      : topology_(topology), sewn_(sewn), spacing_(spacing) {}

  // Whether every pair is listed that is nearer than `reach` (metres) or comes so near during the motion.
  bool covers(const ApproachBound::Motion& motion, double reach) const;
  // Lists them anew, with the margin.
  void make(const ApproachBound::Motion& motion, double reach, Workers& workers);
  // Pairs of two pieces of one layer are left out; they are not at first.
  void onlyLayers(bool only) { onlyLayers_ = only, madeAt_.clear(); }
  // The first node of a pair is the lower.
  const std::vector<std::array<NodeIndex, 2>>& pairs() const { return pairs_; }
  const std::vector<Vec3>& madeAt() const { return madeAt_; }  // where the nodes stood; empty: not made

 private:
  void list(std::span<const Vec3> x, Workers& workers);
  double seamCosine(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const;
  bool openSeam(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const;

  const ClothTopology& topology_;
  const SewnGroups& sewn_;
  double spacing_, reach_ = 0;  // of the list, margin included
  std::vector<std::array<NodeIndex, 2>> pairs_;
  bool onlyLayers_ = false;
  std::vector<Vec3> madeAt_;
  ApproachBound bound_;  // since then
};

}  // namespace karinui
