#pragma once
// Keeps for each of many places how far it was from a collider, so that places far away need no sample at every
// step: clearance is Lipschitz, so a place that has moved little is still far off.
#include <algorithm>
#include <optional>
#include <vector>

#include "karinui/cloth/collider.h"

namespace karinui {

class ClearanceCache {
 public:
  explicit ClearanceCache(std::size_t places) : seen_(places) {}

  void forget() { std::fill(seen_.begin(), seen_.end(), Seen()); }  // the collider moved

  struct Seen {
    Vec3 place;
    double clearance = 0;
    bool showsFar(Vec3 other, double within) const {
      const double spare = clearance - within;
      return spare > 0 && squaredLength((other - place) * Collider::kLipschitz) < spare * spare;
    }
  };
  // The sample of place number k, now here, if it may be nearer to the collider than `within`. Each number by one
  // thread at a time.
  std::optional<Collider::Sample> sampleWithin(const Collider& collider, std::size_t k, Vec3 place, double within) {
    Seen& seen = seen_[k];
    if (seen.showsFar(place, within)) return std::nullopt;
    seen.place = place;
    return collider.sampleWithin(place, within, seen.clearance);
  }
  // The same beside a place that was seen last, which becomes this one if it is looked at.
  std::optional<Collider::Sample> sampleWithin(const Collider& collider, std::size_t k, Vec3 place, double within,
                                               Seen& last) {
    if (last.showsFar(place, within)) return std::nullopt;
    const auto sample = sampleWithin(collider, k, place, within);
    last = seen_[k];
    return sample;
  }

 private:
  std::vector<Seen> seen_;
};

}  // namespace karinui
