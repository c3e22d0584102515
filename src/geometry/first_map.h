#pragma once
// A first flat map of a disk: as angle-true as can be, and without folds.
#include <span>
#include <vector>

#include "geometry/membrane.h"

namespace karinui {

// Least-squares conformal map (Lévy et al. 2002), scaled to the right area; may fold. Empty if it cannot be solved.
std::vector<Flat> conformalMap(std::span<const RestTriangle> rest, std::span<const std::uint32_t> border,
                               std::size_t points, std::span<const Vec3> space);
// Tutte's embedding in a disk of the right area (Tutte 1963): every inner point is the mean of its neighbours; never
// folds.
std::vector<Flat> tutteMap(std::span<const RestTriangle> rest, std::span<const std::uint32_t> border,
                           std::size_t points, std::span<const Vec3> space);

}  // namespace karinui
