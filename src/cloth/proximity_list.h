#pragma once
// Pairs of nodes near each other that may be in contact (a Verlet list). It is made wider than asked and serves until
// some node has moved half of the margin.
#include <array>
#include <span>
#include <vector>

#include "cloth/cloth_topology.h"
#include "cloth/sewn_groups.h"
#include "karinui/base/workers.h"

namespace karinui {

class ProximityList {
 public:
  // All three must outlive this. `spacing`: of the cloth, metres.
  ProximityList(const ClothTopology& topology, const SewnGroups& sewn, double spacing)
      : topology_(topology), sewn_(sewn), spacing_(spacing) {}

  // Whether every pair nearer than `reach` (metres) at x is listed.
  bool covers(std::span<const Vec3> x, double reach) const;
  // Lists them anew, with the margin.
  void make(std::span<const Vec3> x, double reach, Workers& workers);
  // Pairs of two pieces of one layer are left out; they are not at first.
  void onlyLayers(bool only) { onlyLayers_ = only, madeAt_.clear(); }
  // The first node of a pair is the lower.
  const std::vector<std::array<NodeIndex, 2>>& pairs() const { return pairs_; }
  const std::vector<Vec3>& madeAt() const { return madeAt_; }  // where the nodes stood; empty: not made

 private:
  double seamCosine(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const;
  bool openSeam(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const;

  const ClothTopology& topology_;
  const SewnGroups& sewn_;
  double spacing_, reach_ = 0;  // of the list, margin included
  std::vector<std::array<NodeIndex, 2>> pairs_;
  bool onlyLayers_ = false;
  std::vector<Vec3> madeAt_;
};

}  // namespace karinui
