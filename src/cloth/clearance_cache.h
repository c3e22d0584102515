#pragma once
// Keeps for each of many places how far it was from a collider, so that places far away need no sample at every
// step: clearance is Lipschitz, so a place that has moved little is still far off.
#include <algorithm>
#include <vector>

#include "karinui/cloth/collider.h"

namespace karinui {

class ClearanceCache {
 public:
  explicit ClearanceCache(std::size_t places) : seen_(places) {}

  void forget() { std::fill(seen_.begin(), seen_.end(), Seen()); }  // the collider moved

  // Whether place number k, now here, may be nearer to the collider than `within`. Each number by one thread at a time.
  bool mayBeWithin(const Collider& collider, std::size_t k, Vec3 place, double within) {
    Seen& seen = seen_[k];
    const double spare = seen.clearance - within;
    if (spare > 0 && squaredLength((place - seen.place) * Collider::kLipschitz) < spare * spare) return false;
    seen = {place, collider.clearance(place)};
    return seen.clearance < within;
  }

 private:
  struct Seen {
    Vec3 place;
    double clearance = 0;
  };
  std::vector<Seen> seen_;
};

}  // namespace karinui
