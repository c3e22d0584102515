#pragma once
// A plane through figure and garment, taken apart by what of the figure it runs round: trunk, arms and legs. Cloth is
// round what it is nearest to.
#include <map>
#include <vector>

#include "karinui/geometry/section.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

struct PartsAt {
  std::map<BodyPoint::Part, std::vector<Vec3>> figure, cloth;

  BodyPoint::Part nearest(Vec3 place) const;  // the trunk where there is no figure
  bool legIsClad(BodyPoint::Part leg) const;  // by cloth of its own all round; else trunk and legs are one
  std::vector<Vec3> trunk(const std::map<BodyPoint::Part, std::vector<Vec3>>& of) const;  // with the legs
};
PartsAt partsAt(const GarmentSnapshot& snapshot, const Plane& plane);

// Whether the places lie on all sides of the figure: a hem that hangs lower at the back than in front goes round
// nothing. `open`: the widest gap, radians.
bool allRound(const std::vector<Vec3>& places, const std::vector<Vec3>& figure, double open);

}  // namespace karinui
