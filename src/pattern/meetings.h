#pragma once
// Where a line of places meets curves.
#include <optional>
#include <utility>
#include <vector>

#include "divide_edges.h"

namespace karinui {

struct Meeting {  // of the line with the outline
  double at = 0;  // segments of the line walked, with a fraction
  EdgePlace on;
  Flat place;
};

// How far along the segment from `a` to `b` it meets the one from `c` to `d`, and in `other` how far along that.
std::optional<double> segmentMeets(Flat a, Flat b, Flat c, Flat d, double& other);
// All places where the line meets the outline's edges, added to `found`.
void meetings(const std::vector<Flat>& line, const Outline& outline, std::vector<Meeting>& found);
// The parts of a curve to either side of a line, in order, each with the share of the curve's length at which it
// begins.
std::vector<std::pair<double, Curve>> partsAcross(const Curve& curve, const std::vector<Flat>& line);

}  // namespace karinui
