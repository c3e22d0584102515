#pragma once
// Flat polygons: closed rings of points without a repeated last one. Thin, exact wrapping of GEOS (LGPL) where it serves.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/mesh.h"
#include "karinui/geometry/vec.h"

namespace karinui {

using Ring = std::vector<Flat>;

double signedArea(std::span<const Flat> ring);  // > 0: counter-clockwise
double perimeter(std::span<const Flat> ring);
bool contains(std::span<const Flat> ring, Flat place);             // even-odd
double distanceToRing(std::span<const Flat> ring, Flat place);     // >= 0
std::optional<Flat> crossing(std::span<const Flat> ring);          // where the ring crosses or touches itself
// Triangles of the region inside `outer` and outside `holes` (constrained Delaunay) that uses exactly the rings' points
// and `inner` points; indices count outer, then each hole, then inner.
Result<std::vector<Triangle>> triangulate(std::span<const Flat> outer, std::span<const Ring> holes,
                                          std::span<const Flat> inner);

}  // namespace karinui
