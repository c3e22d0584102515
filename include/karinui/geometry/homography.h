#pragma once
// The map of one plane onto another as a pinhole camera sees it: straight lines stay straight. Pure; any thread.
#include <array>
#include <optional>

#include "karinui/geometry/vec.h"

namespace karinui {

class Homography {
 public:
  // The one map that takes each place of `from` to that of `to`; nothing where three of either lie on a line (Hartley
  // and Zisserman, Multiple View Geometry, 2004, 4.1).
  static std::optional<Homography> through(const std::array<Flat, 4>& from, const std::array<Flat, 4>& to);
  Flat operator()(Flat p) const;
  // What the place is divided by: it changes its sign where the plane's horizon lies, and has none of its own.
  double depth(Flat p) const { return h_[6] * p.u + h_[7] * p.v + 1; }

 private:
  std::array<double, 8> h_{1, 0, 0, 0, 1, 0, 0, 0};
};

// Whether four places are the corners of a convex figure, in their order.
bool convex(const std::array<Flat, 4>& corners);

}  // namespace karinui
