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

// The angle about y from z towards x at which its trunk stands, radians, below a quarter turn either way: where the
// sections from the hips to below the arms, broader than deep, have their short axis. The feet may point elsewhere.
// Nothing where the sections do not agree.
std::optional<double> trunkAngle(const TriangleMesh& mesh);

}  // namespace karinui
