#pragma once
// The god-object (Zilles and Salisbury 1995): a point that follows the device but never enters a surface. It goes on
// from where it was, so it cannot pop through an edge, a thin part, or a sheet that is felt from both sides. No
// allocation; one thread.
#include <array>
#include <cstdint>

#include "karinui/touch/touch_scene.h"

namespace karinui {

class Proxy {
 public:
  static constexpr double kClear = 1e-5;  // metres it keeps from the surface
  struct Contact {
    bool touching = false;
    Vec3 proxy;
    Vec3 normal;       // unit, from the device to the proxy; zero without contact
    double depth = 0;  // metres from the surface to the device
  };
  // Forgets where it was; the next follow() begins at the device.
  void reset() { placed_ = false; }
  void reset(Vec3 place) { place_ = place, placed_ = true; }
  Vec3 place() const { return place_; }
  // Coulomb friction: the proxy lags behind by at most `friction` times the depth.
  Contact follow(Vec3 device, const TouchScene& scene, double friction);

 private:
  struct Plane {
    Vec3 normal;
    double offset = 0;  // normal . g >= offset
  };
  static constexpr std::size_t kMostNear = 1024, kMostPlanes = 8;
  void gather(Vec3 device, const TouchScene& scene, double friction);
  // The first facet on the way, as a share of it, or 1 with no facet.
  double firstHit(Vec3 from, Vec3 to, const TouchScene& scene, const Facet*& hit, double& side) const;
  Vec3 place_;
  bool placed_ = false, all_ = false;
  std::size_t nearCount_ = 0;
  std::array<std::uint32_t, kMostNear> near_{};
};

}  // namespace karinui
