#include "cloth/pair_friction.h"

#include <algorithm>
#include <cmath>

#include "cloth/collider_contact.h"

namespace karinui {
namespace {

constexpr double kPushShare = 0.2;      // of the newest push in the average
constexpr double kLeastStretch = 1e-8;  // metres: an anchor whose spring may stretch no further is dropped

}  // namespace

double PairFriction::coefficientOf(const ContactPair& pair) const {
  return std::sqrt(coefficient_[pair.node[0]] * coefficient_[pair.node[3]]);
}

// How far the anchored points have been drawn apart, along the cloth.
Vec3 PairFriction::pullOf(const ContactPair& pair, const Anchor& anchor, std::span<const Vec3> x) {
  Vec3 pull = anchor.offset;
  for (int k = 0; k < 4; ++k) pull += x[pair.node[k]] * anchor.weight[k];
  return pull - pair.normal * dot(pull, pair.normal);
}

void PairFriction::apply(std::vector<ContactPair>& pairs, std::span<const Vec3> x, bool sliding) {
  hold_.clear();
  for (ContactPair& pair : pairs) {
    hold_.push_back(holdOf(pair, x));
    if (sliding && hold_.back().anchor.slip > kLeastSlip) pair.across = 0;
  }
}

PairFriction::Hold PairFriction::holdOf(ContactPair& pair, std::span<const Vec3> x) const {
  Hold hold;
  const auto at = std::lower_bound(stuck_.begin(), stuck_.end(), pair.node,
                                   [](const Stuck& s, const std::array<NodeIndex, 4>& n) { return s.node < n; });
  if (at == stuck_.end() || at->node != pair.node) {
    hold.anchor.weight = pair.weight;
    hold.anchor.push = pair.push;
    pair.across = stiffnessAt(coefficientOf(pair) * pair.push, 0);
    return hold;
  }
  hold.anchor = at->anchor;
  hold.anchor.push = std::lerp(at->anchor.push, pair.push, kPushShare);
  const double most = coefficientOf(pair) * hold.anchor.push;
  if (most <= 0) return hold;
  const Vec3 pull = pullOf(pair, hold.anchor, x);
  const double length = karinui::length(pull), slip = hold.anchor.slip;
  const double spring = stiffnessAt(most, length);
  pair.across = slip > 0 ? std::fmin(spring, most / (length + slip)) : spring;
  hold.force = pull * spring;
  if (slip > 0 && length > 0) hold.slipForce = pull * (pair.across * slip / length);
  return hold;
}

void PairFriction::afterStep(const std::vector<ContactPair>& pairs, std::span<const Vec3> x) {
  std::vector<Stuck> kept;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const ContactPair& pair = pairs[p];
    Vec3 apart;
    for (int k = 0; k < 4; ++k) apart += x[pair.node[k]] * pair.weight[k];
    Anchor anchor = hold_[p].anchor;
    const double gap = dot(apart, pair.normal);
    const double stiffest = coefficientOf(pair) * anchor.push / stiffness_;  // metres the stiffest spring stretches
    if (stiffest <= kLeastStretch) continue;
    const double most = std::fmax(stiffest, stretch_);
    const Vec3 pull = pullOf(pair, anchor, x);
    const double length = karinui::length(pull);
    anchor.slip = std::fmax(0.0, length - most);
    if (anchor.slip > 0) {
      anchor.weight = pair.weight;
      anchor.offset = pull * (most / length) - (apart - pair.normal * gap);
    }
    kept.push_back({pair.node, anchor});
  }
  std::sort(kept.begin(), kept.end(), [](const Stuck& a, const Stuck& b) { return a.node < b.node; });
  stuck_ = std::move(kept);
}

}  // namespace karinui
