#pragma once
// A rigid surface that cloth may not enter. Metres. A collider is immutable
// while a drape uses it; its functions are asked from several threads at once.
#include <array>
#include <memory>

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
  // The exact distance, dearer: asked once at rest, so that nothing rests below the surface itself.
  virtual Sample exactSample(Vec3 place) const { return sample(place); }
  // The outward direction, unit, of the surface that intersects a face of cloth between its corners; zero: none does.
  virtual Vec3 intersectionNormal(const std::array<Vec3, 3>&) const { return {}; }
};

// The body's distance field.
std::unique_ptr<Collider> fieldCollider(BodyPtr body);

}  // namespace karinui
