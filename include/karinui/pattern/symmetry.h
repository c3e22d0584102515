#pragma once
// The symmetry a piece of paper has by itself: its left half is the mirror image of its right one. Pure; any thread.
// Metres on paper.
#include <optional>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct PaperSymmetry {
  Flat through, axis{0, 1};          // unit
  std::vector<std::size_t> partner;  // of each edge: the one it is the image of, itself if it crosses the axis
  Curve image(const Curve& curve) const { return curve.mirrored(through, axis); }
  Flat image(Flat place) const { return image(Curve::line(place, place)).start; }
  Flat imageOf(Flat step) const { return axis * (2 * dot(step, axis)) - step; }
};

// The symmetry about the line nearest to the paper's upright, if the outline has one to a fiftieth of a millimetre.
std::optional<PaperSymmetry> symmetryOf(const Outline& outline);

// The outline made exactly symmetric again, after changes that ought to have been.
Outline symmetrised(Outline outline, const PaperSymmetry& symmetry);

// What was done to corners and edges of one half of `before`, done to their partners too. What was not touched stays
// bit for bit.
Outline onBothHalves(const Outline& before, Outline now, const PaperSymmetry& symmetry);

}  // namespace karinui
