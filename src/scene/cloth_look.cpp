#include "karinui/scene/cloth_look.h"

#include <cmath>

namespace karinui {

std::array<Flat, 2> printAxes(const ClothLook& look) {
  const Flat across{look.grain.v, -look.grain.u};
  const double c = std::cos(look.turn), s = std::sin(look.turn);
  return {across * c + look.grain * s, look.grain * c - across * s};
}

}  // namespace karinui
