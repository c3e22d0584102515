#pragma once
// Elastics along edges: a row of tension-only springs beyond the elastic's own, cut length (springs.h). Each spans a
// fold's worth of edge, so that the cloth between its ends is free to fold, and they overlap, so that the folds may
// begin anywhere: at any place of the edge the springs that pass it pull as the elastic does. Where cells are wider
// than a fold, the cloth is squeezed within its cells instead, as an eased seam squeezes it.
#include "cloth/springs.h"
#include "karinui/cloth/pulls.h"

namespace karinui {

std::vector<Springs::Spring> elasticSprings(const Cloth& cloth);  // of the live pieces

}  // namespace karinui
