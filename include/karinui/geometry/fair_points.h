#pragma once
// A line of points without its short waves. Metres on paper. Pure; any thread.
#include <span>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

// The directions in which a line begins and ends that are to stay.
struct KeptDirections {
  bool atStart = false, atEnd = false;
};

// Points that lie about evenly, with waves shorter than `shortest` taken out of them. The ends stay, and where their
// direction is kept, so do the points next to them. Lines stay as they are, and arcs nearly: the variation of curvature
// is made least, not curvature (Moreton and Séquin: Functional Optimization for Fair Surface Design, 1992). At least
// four points.
std::vector<Flat> withoutWaves(std::span<const Flat> points, double shortest, KeptDirections kept = {});

}  // namespace karinui
