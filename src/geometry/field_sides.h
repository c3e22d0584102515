#pragma once
// On which side of a closed mesh the points of a box of a grid lie.
#include <cstdint>
#include <vector>

#include "geometry/spaced_grid.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

// 1 outside, -1 inside, for each of the points from `first` on, `count` of them each way, x first; `distance`: of these
// to the mesh, metres, no more than it is.
std::vector<std::int8_t> sidesOf(const SpacedGrid& grid, const Count& first, const Count& count,
                                 const std::vector<float>& distance, const Bvh& bvh);

}  // namespace karinui
