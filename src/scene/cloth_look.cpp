#include "karinui/scene/cloth_look.h"

#include "karinui/geometry/axes.h"

namespace karinui {

std::array<Flat, 2> printAxes(const ClothLook& look) { return axes(look.grain, look.turn); }

}  // namespace karinui
