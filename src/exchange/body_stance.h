#pragma once
// How a stranger's body stands, told by its own shape: a person has two legs, feet that point forwards and one head.
#include <optional>

#include "karinui/geometry/mesh.h"

namespace karinui {

// Along one of the axes, either way.
struct Uprightness {
  int axis = 1;       // 0, 1, 2: x, y, z
  bool down = false;  // the head is at the axis' lower end
};
// Nothing: no person, or not surely one, as a trunk, a dress form, a skirt or legs that touch.
std::optional<Uprightness> uprightnessOf(const TriangleMesh& mesh);

// Of a mesh that stands along y, the feet below.
struct Facing {
  Vec3 front;       // unit, level
  double legs = 0;  // how high they part, as a share of the height
};
std::optional<Facing> facingOf(const TriangleMesh& mesh);

}  // namespace karinui
