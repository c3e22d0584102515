#pragma once
// A limb or the trunk as something to wrap cloth round: its frame, and its skin seen along its axis. Metres.
#include <vector>

#include "karinui/body/body.h"
#include "karinui/design/document.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

// A right-handed frame with y along the limb, towards the head; z out of the body at the anchor.
struct LimbFrame {
  Vec3 origin, right, up, out;
  Flat onPlane(Vec3 p) const {
    return {dot(p - origin, right), -dot(p - origin, out)};
  }  // counter-clockwise seen from above
  Vec3 inSpace(Flat p, double height) const { return origin + right * p.u - out * p.v + up * height; }
};

// The limb's own skin: places all round it, ring by ring along the chart. A direction that runs into the trunk has
// none, so a ring near the shoulder or the crotch is open on its inner side.
struct LimbRing {
  double along = 0;
  Vec3 middle;
  std::vector<Vec3> skin;
};

bool isLimb(BodyPoint::Part part);
std::vector<LimbRing> ringsOf(const Body& body, BodyPoint::Part part);
// Towards the head along the stretch of the limb from `low` to `high` (metres towards the head from the anchor).
Vec3 axisOver(const std::vector<LimbRing>& rings, Vec3 anchor, double low, double high);
// The skin that a piece passes whose paper, about the anchor, is in `box`; seen along the axis, with its height.
struct SkinPlace {
  Flat place;
  double height = 0;
};
std::vector<SkinPlace> ringsAround(const std::vector<LimbRing>& rings, const LimbFrame& limb, const FlatBox& box);
// The same round the trunk: loops of level sections that lie over the anchor's own one (not arms, not the whole
// figure); with both legs, also those that lie under the ones of the level above, as legs that stand apart do.
std::vector<SkinPlace> levelsAround(const Body& body, const LimbFrame& limb, const FlatBox& box, bool bothLegs);
// The cloth of other pieces that stands round the limb there, no further than a hand from what `skin` holds.
std::vector<SkinPlace> clothAround(const Document& document, PieceId without, const LimbFrame& limb, const FlatBox& box,
                                   const std::vector<SkinPlace>& skin);

Ring hull(std::vector<Flat> points);          // counter-clockwise
Ring grown(const Ring& convex, double ease);  // outwards, corners rounded

}  // namespace karinui
