#pragma once
// On which side of a closed mesh the points of a grid lie.
#include <cstdint>
#include <vector>

#include "geometry/spaced_grid.h"
#include "karinui/base/token.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

// 1 outside, -1 inside, per point; `distance`: to the mesh, metres, no more than it is. Not all are known when
// cancelled.
std::vector<std::int8_t> sidesOf(const SpacedGrid& grid, const std::vector<float>& distance, const Bvh& bvh,
                                 const Token& token);

}  // namespace karinui
