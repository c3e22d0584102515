#pragma once
// How tightly a garment goes round the trunk, asked before it is draped. Cloth that is too small never comes to rest:
// it slips, rolls up and is torn. At each level the loop that the sewn pieces make, as long as on paper, is compared
// with the tight tape round the body. Cloth pulled by T newtons a metre round a radius R presses by T / R; a garment is
// too small that would have to press by more than kMostPressure (Denton, Fit, stretch and comfort, 1972: discomfort
// begins at 6 to 10 kPa). Metres, pascals. Pure; any thread.
#include <optional>

#include "karinui/body/body.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

inline constexpr double kMostPressure = 6000;  // Pa

struct GirthLoop {
  double height = 0;     // above the floor, of the body's level it is compared with
  double garment = 0;    // round, as cut
  double stretched = 0;  // round, pulled until it presses by kMostPressure
  double body = 0;       // the tight tape
  bool tight() const { return garment < body; }
  double shortage() const { return body - stretched; }
};
// The loop that lacks most, the garment moved up or down by at most 12 cm to where it fits best. Compared are loops
// that are sewn up all round and go round the trunk between knee and armpit; none if there are none, if nodes are
// pinned, or if the body's levels are not known.
std::optional<GirthLoop> tightestLoop(const Cloth& cloth, const ClothState& state, const Body& body);

}  // namespace karinui
