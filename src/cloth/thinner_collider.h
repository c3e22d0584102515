#pragma once
// A collider with its surface moved inwards by an amount that is taken back step by step: tight cloth is sewn up on it
// where it stands, and is then stretched by the surface that comes out under it. The surface moves everywhere, or only
// around some places, as at an armpit. One thread at a time changes the amount, while no drape's step is under way.
#include <algorithm>
#include <vector>

#include "karinui/cloth/collider.h"

namespace karinui {

class ThinnerCollider : public Collider {
 public:
  // The collider must outlive it. `by`: metres.
  ThinnerCollider(const Collider& whole, double by) : whole_(whole), by_(by) {}
  double by() const { return by_; }
  void setBy(double by) { by_ = by; }
  void setPlaces(std::vector<Vec3> places) { places_ = std::move(places); }  // none: everywhere

  Sample sample(Vec3 place) const override {
    Sample found = whole_.sample(place);
    found.distance += by_ * shareAt(place);
    return found;
  }
  // Of the whole one, which is a lower bound at every stage: what is kept of it stays true while the surface grows.
  double clearance(Vec3 place) const override { return whole_.clearance(place); }
  Vec3 intersectionNormal(const std::array<Vec3, 3>& corners) const override {
    return by_ == 0 ? whole_.intersectionNormal(corners) : Vec3{};
  }

 private:
  static constexpr double kWhole = 0.08, kFade = 0.08;  // metres: an armhole is within 12 cm of its armpit

  double shareAt(Vec3 place) const {
    if (places_.empty() || by_ == 0) return 1;
    double share = 0;
    for (const Vec3& near : places_)
      share = std::max(share, std::clamp(1 - (distance(place, near) - kWhole) / kFade, 0.0, 1.0));
    return share;
  }

  const Collider& whole_;
  double by_;
  std::vector<Vec3> places_;
};

}  // namespace karinui
