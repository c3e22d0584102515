#pragma once
// Remembers how far off the body places were, so that those far off are not asked about again at every step.
#include <vector>

#include "karinui/cloth/collider.h"

namespace karinui {

class FarOff {
 public:
  explicit FarOff(std::size_t places) : seen_(places) {}

  // Whether place number k, now here, may be nearer to the body than `within`. Each number by one thread at a time.
  bool mayBeWithin(const Collider& body, std::size_t k, Vec3 place, double within) {
    Seen& seen = seen_[k];
    const double spare = seen.clearance - within;
    if (spare > 0 && squaredLength((place - seen.place) * Collider::kLipschitz) < spare * spare) return false;
    seen = {place, body.clearance(place)};
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
