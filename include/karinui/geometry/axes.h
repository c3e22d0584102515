#pragma once
// The two directions of a print or a weave on paper. Pure; any thread.
#include <array>
#include <cmath>

#include "karinui/geometry/vec.h"

namespace karinui {

// Unit steps across and along something that runs upwards along `grain` (unit), turned counter-clockwise from it.
inline std::array<Flat, 2> axes(Flat grain, double turn = 0) {
  const Flat across{grain.v, -grain.u};
  const double c = std::cos(turn), s = std::sin(turn);
  return {across * c + grain * s, grain * c - across * s};
}

}  // namespace karinui
