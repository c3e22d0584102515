#pragma once
// Lays cloth that is gathered much in even waves before it is drawn in: drawn in flat it crumples, and passes through
// itself. Pure; any thread.
#include "karinui/cloth/cloth.h"

namespace karinui {

// Lays each live piece that stands flat, is not pinned and has a straight edge gathered by 2.4:1 or more in waves
// across that edge, two nodes each, so that it is as wide as what it is sewn to; no thread is stretched. `x`: where the
// nodes stand, metres. Whether there was such a piece: it must meet itself while it is sewn (Cloth::pleated).
bool layGathersInWaves(const Cloth& cloth, std::vector<Vec3>& x);

}  // namespace karinui
