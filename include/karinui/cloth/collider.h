#pragma once
// Rigid surfaces that cloth may not enter, and the list of those that one drape meets. Metres. A collider is immutable
// while a drape uses it; its functions are asked from several threads at once.
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "karinui/body/body.h"

namespace karinui {

class Collider {
 public:
  virtual ~Collider() = default;
  struct Sample {
    double distance = 0;  // to the surface, negative inside
    Vec3 normal;          // unit, outwards
  };
  virtual Sample sample(Vec3 place) const = 0;  // asked at every step
  // A cheap lower bound of the distance. Its Lipschitz constant is at most kLipschitz.
  virtual double clearance(Vec3 place) const = 0;
  static constexpr double kLipschitz = 2;
  bool mayBeWithin(Vec3 place, double distance) const { return clearance(place) < distance; }
  // The sample of a place whose clearance, which is given as well, is less than `within`; of others none.
  virtual std::optional<Sample> sampleWithin(Vec3 place, double within, double& clearance) const {
    clearance = this->clearance(place);
    return clearance < within ? std::optional(sample(place)) : std::nullopt;
  }
  // The exact distance, dearer: asked once at rest, so that nothing rests below the surface itself.
  virtual Sample exactSample(Vec3 place) const { return sample(place); }
  // The outward direction, unit, of the surface that intersects a face of cloth between its corners; zero: none does.
  virtual Vec3 intersectionNormal(const std::array<Vec3, 3>&) const { return {}; }
};

// The body's distance field.
std::unique_ptr<Collider> fieldCollider(BodyPtr body);

// The colliders of one drape. Where two of them ask for opposite moves of a node within a step, the one added first is
// obeyed. Holds no collider: each must outlive the list and the drape.
class ColliderList {
 public:
  struct Entry {
    const Collider* collider = nullptr;
    std::optional<double> friction;  // Coulomb's coefficient against any cloth; none: each fabric's `frictionBody`
  };
  ColliderList() = default;
  ColliderList(const Collider& only) { add(only); }  // implicit: most drapes meet a body and nothing else
  ColliderList& add(const Collider& collider, std::optional<double> friction = {}) {
    entries_.push_back({&collider, friction});
    return *this;
  }
  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace karinui
