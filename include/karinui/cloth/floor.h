#pragma once
// The floor that the figure stands on. Heights are y, metres.
#include <memory>

#include "karinui/cloth/cloth.h"
#include "karinui/cloth/collider.h"

namespace karinui {

// All below `height` is inside.
std::unique_ptr<Collider> floorCollider(double height = 0);

// Where cloth reaches below the floor, as a gown placed upright whose hem is longer than it stands high, it is folded
// outwards there and laid on the floor: each node goes as far along the floor as it was below it, the way its side of
// the cloth faces. Upright flat pieces keep their lengths. An outer layer comes over an inner one. Only live pieces;
// cloth that is above the floor keeps its bits.
void layOnFloor(const Cloth& cloth, ClothState& state, double height = 0);

}  // namespace karinui
