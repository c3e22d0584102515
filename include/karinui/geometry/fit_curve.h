#pragma once
// Clean edges from measured points: a straight line where the points are straight enough, else a smooth chain of few
// cubics.
// Metres on paper. Pure; any thread.
#include <optional>
#include <span>
#include <vector>

#include "karinui/geometry/curve.h"

namespace karinui {

struct FitSettings {
  double straight = 0.0005;   // points nearer than this to the chord make a straight line
  double tolerance = 0.0003;  // how far cubics may pass from the points
  double shortest = 0;        // metres of points a cubic has at least: keeps the chain from rippling …
  double farthest = 0.0005;   // … unless it would pass farther than this
  double firmEnds = 0;  // metres: an end whose direction is not given has that of the points so near to it; 0: any
  int pieces = 1;       // how many curves of equal length, each a chain of its own (a line stays a line)
};

struct Fitted {
  std::vector<Curve> curves;  // joined end to end, with a common tangent where they join
  double miss = 0;            // how far the furthest point is from them
};
// The ends are kept exactly; at an end whose direction is given (unit, as the curve runs) the tangent is exactly that.
// At least two points.
Fitted fitEdge(std::span<const Flat> points, const FitSettings& settings = {},
               const std::optional<Flat>& startWay = std::nullopt, const std::optional<Flat>& endWay = std::nullopt);

// How far the points are from the straight line between the first and the last.
double bow(std::span<const Flat> points);

}  // namespace karinui
