#pragma once
// A sector of a ring stood round the trunk or a limb as a cone. Metres.
#include <optional>
#include <vector>

#include "design/operations/limb.h"
#include "karinui/base/result.h"

namespace karinui {

// A piece cut from a ring: two straight sides that run to one middle, and an inner edge that is an arc about it.
struct RingSector {
  Flat middle;
  double inner = 0, depth = 0;  // radius of the inner edge; from there to the furthest of the piece
  double angle = 0;             // of the sector
  Flat towards;                 // unit, from the middle through the sector's own middle
};
std::optional<RingSector> sectorOf(const Piece& piece);

// A general cone, as paper bends without stretching: what is at polar place (r, phi) of the paper about the ring's
// middle is at r along the ruling that phi leads to, phi counting the angle between rulings. (Do Carmo, Differential
// Geometry of Curves and Surfaces, 3-5.)
struct Cone {
  Vec3 apex;
  std::vector<Vec3> ruling;   // unit, round the limb; of a closed one the first repeated at the end
  std::vector<double> angle;  // of each from the first, 0 … total
  double start = 0;           // the angle of the sector's middle
  bool closed = true;         // goes once round; else it is wound, and begins and ends
  RingSector sector;
  Vec3 place(Flat paper) const;
};
// The cone clear of the skin below the inner edge by the ease, its inner edge at the limb's origin; where the sector is
// wider than what goes round there, it stands further off. Refuses a ring too small to go round.
Result<Cone> coneRound(const RingSector& sector, const LimbFrame& limb, const std::vector<SkinPlace>& skin,
                       double ease);

// The same for a sector that is wider than the way round, as a wrap skirt: it is wound as near as the ease lets it, one
// end over the other. `endOnTop`: the one its angles grow to, counter-clockwise on the paper.
Result<Cone> coneWound(const RingSector& sector, const LimbFrame& limb, const std::vector<SkinPlace>& skin, double ease,
                       bool endOnTop);
// On which side of the sector's middle a place of the paper is: from -0.5, where its angles begin, to 0.5.
double shareOf(const RingSector& sector, Flat paper);

}  // namespace karinui
