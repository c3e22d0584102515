#pragma once
// Lays cloth between the two layers it was put between. A lining is laid beneath its piece at a fixed distance, and
// goes through what lies closer beneath: a shirt under a waistcoat. Cloth that begins so takes a hundred steps to come
// apart again. Pure; any thread.
#include "karinui/cloth/cloth.h"

namespace karinui {

// Of each live piece that goes through an inner layer where it lies close beneath an outer one: lays its nodes between
// those two. `x`: where the nodes stand, metres. Whether there was such a piece.
bool layBetween(const Cloth& cloth, std::vector<Vec3>& x);

}  // namespace karinui
