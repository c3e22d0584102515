#pragma once
// Flat polygons: closed rings of points without a repeated last one. Metres. Pure; any thread. Thin, exact wrapping of
// GEOS (LGPL) where it serves.
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
FlatBox boxOf(std::span<const Flat> places);
bool contains(std::span<const Flat> ring, Flat place);          // even-odd
double distanceToRing(std::span<const Flat> ring, Flat place);  // >= 0
double distanceToSegment(Flat a, Flat b, Flat place);           // >= 0
std::optional<Flat> crossing(std::span<const Flat> ring);       // where the ring crosses or touches itself

// Triangles of the region inside `outer` and outside `holes` (constrained Delaunay) that uses exactly the rings' points
// and `inner` points; indices count outer, then each hole, then inner. Triangles are counter-clockwise. Refuses rings
// that cross. A ring may run back over itself (a slit) or touch itself in a point: equal places then stay separate
// points, each with the triangles on its own side.
Result<std::vector<Triangle>> triangulate(std::span<const Flat> outer, std::span<const Ring> holes,
                                          std::span<const Flat> inner);

// The same for any region given by directed sides (pairs of indices into `points`, the region on their left); points on
// no side are inner points, and those outside the region stay unused. `clash` tells two sides that cross, if that is
// why it is refused.
struct SideClash {
  std::size_t first = 0, second = 0;
};
using RegionSide = std::array<std::uint32_t, 2>;
Result<std::vector<Triangle>> triangulateRegion(std::span<const Flat> points, std::span<const RegionSide> sides,
                                                std::optional<SideClash>* clash = nullptr);

}  // namespace karinui
