#pragma once
// A collider with its surface moved inwards by an amount that is taken back step by step: tight cloth is sewn up on it
// where it stands, and is then stretched by the surface that comes out under it. One thread at a time changes the
// amount, while no drape's step is under way.
#include "karinui/cloth/collider.h"

namespace karinui {

class ThinnerCollider : public Collider {
 public:
  // The collider must outlive it. `by`: metres.
  ThinnerCollider(const Collider& whole, double by) : whole_(whole), by_(by) {}
  double by() const { return by_; }
  void setBy(double by) { by_ = by; }

  Sample sample(Vec3 place) const override {
    Sample found = whole_.sample(place);
    found.distance += by_;
    return found;
  }
  // Of the whole one, which is a lower bound at every stage: what is kept of it stays true while the surface grows.
  double clearance(Vec3 place) const override { return whole_.clearance(place); }

 private:
  const Collider& whole_;
  double by_;
};

}  // namespace karinui
