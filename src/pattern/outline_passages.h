#pragma once
// Where straight lines pass an outline, and the parts of its edges between two such places: of pleats that are drawn.
#include <optional>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct Passage {
  std::size_t edge = 0;
  double t = 0;  // the curve's parameter
  Flat place;
};
// Of the places p of the outline with dot(p, normal) = offset the one nearest to a place.
std::optional<Passage> passageNear(const Outline& outline, Flat normal, double offset, Flat near);

struct EdgeStretch {
  std::size_t edge = 0;
  double t0 = 0, t1 = 1;  // the curve's parameters
};
// From one place of the outline on to the other, as it runs; without what is shorter than a thousandth of a millimetre.
std::vector<EdgeStretch> stretchesBetween(const Outline& outline, const Passage& from, const Passage& to);

}  // namespace karinui
