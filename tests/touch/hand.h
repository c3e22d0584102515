#pragma once
// Scenes and a simulated hand for the tests of touch.
#include <vector>

#include "karinui/touch/servo_step.h"

namespace karinui {

inline void add(TouchScene& scene, Vec3 a, Vec3 b, Vec3 c, bool twoSided = false) {
  if (const auto facet = facetOf(a, b, c, twoSided)) scene.facets.push_back(*facet);
}

// The plane y = 0, felt from above.
inline TouchScene floorScene() {
  TouchScene scene;
  add(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1});
  add(scene, {-1, 0, -1}, {1, 0, 1}, {1, 0, -1});
  scene.radius = 10;
  return scene;
}

// A box around the origin, of these half sizes.
inline TouchScene boxScene(Vec3 half) {
  TouchScene scene;
  const auto side = [&](Vec3 n, Vec3 u, Vec3 v) {
    add(scene, n - u - v, n + u - v, n + u + v);
    add(scene, n - u - v, n + u + v, n - u + v);
  };
  const Vec3 x{half.x, 0, 0}, y{0, half.y, 0}, z{0, 0, half.z};
  side(x, y, z), side(-x, z, y), side(y, z, x), side(-y, x, z), side(z, x, y), side(-z, y, x);
  scene.radius = 10;
  return scene;
}

inline DeviceRecord touchRecord() {
  DeviceRecord record;
  record.name = "test";
  record.freedomOut = 3;
  record.force = 3.3;
  record.stiffness = 400;
  record.damping = 4;
  return record;
}

inline HandSample handAt(Vec3 place, Vec3 velocity = {}) {
  HandSample hand;
  hand.tip.carry = place;
  hand.velocity = velocity;
  hand.ready = true;
  return hand;
}

}  // namespace karinui
