#pragma once
// A slit is an outline that goes in along a line and comes back along the same line. Here such stretches are found, so
// that the rest of the outline can be judged as an ordinary simple curve and both banks can be divided alike.
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

// The outline runs to its length `tip` and back: the places tip - x and tip + x are the same for x in [0, reach].
struct Retrace {
  std::size_t edge = 0;  // the edge that ends at the tip
  double tip = 0, reach = 0;
};
std::vector<Retrace> retraces(const Outline& outline);

// The flattened outline without its slits, and the slits as open lines from mouth to tip.
struct OpenedOut {
  Ring ring;
  std::vector<std::vector<Flat>> slits;
};
OpenedOut withoutSlits(const Outline& outline, double miss);

}  // namespace karinui
