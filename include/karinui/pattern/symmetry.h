#pragma once
// The symmetry a piece of paper has by itself: its left half is the mirror image of its right one. A slit or a dart on
// one half does not end it: what it divided has no counterpart, all else does. Pure; any thread. Metres on paper.
#include <optional>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct PaperSymmetry {
  Flat through, axis{0, 1};  // unit
  // Of each edge: the one it is the image of, itself if it crosses the axis; none where a slit or dart left it none.
  std::vector<std::optional<std::size_t>> partner;
  // Of the corner each edge starts at: the edge that starts at its image; none as above.
  std::vector<std::optional<std::size_t>> corner;
  Curve image(const Curve& curve) const { return curve.mirrored(through, axis); }
  Flat image(Flat place) const { return image(Curve::line(place, place)).start; }
  Flat imageOf(Flat step) const { return axis * (2 * dot(step, axis)) - step; }
};

// The symmetry about the line nearest to the paper's upright, if the outline has one to a fiftieth of a millimetre, or
// would have it without its slits and darts (at least half its length has a counterpart then).
std::optional<PaperSymmetry> symmetryOf(const Outline& outline);

// A place on an edge, by the share of its length.
struct OutlinePlace {
  std::size_t edge = 0;
  double at = 0;
};
// The mirror image of a place, where the other half has one there: also on a part of a divided edge.
std::optional<OutlinePlace> imageOf(const Outline& outline, const PaperSymmetry& symmetry, const OutlinePlace& place);

// A curve that crosses the axis made its own image.
Curve evenAcross(const Curve& curve, const PaperSymmetry& symmetry);

// The outline made exactly symmetric again, after changes that ought to have been. Edges without a counterpart only
// follow at their ends.
Outline symmetrised(Outline outline, const PaperSymmetry& symmetry);

// What was done to corners and edges of one half of `before`, done to their partners too. What was not touched stays
// bit for bit.
Outline onBothHalves(const Outline& before, Outline now, const PaperSymmetry& symmetry);

}  // namespace karinui
