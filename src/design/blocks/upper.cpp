// Bodice and shirt.
#include <algorithm>
#include <cmath>

#include "design/blocks/draft.h"

namespace karinui {

namespace {

BodyPoint torsoWaist(double around) {
  BodyPoint at;
  at.part = BodyPoint::Part::Torso, at.along = 3, at.around = around;
  return at;
}

struct Upper {
  UpperHalf front, back;
};
// What the drafts have in common: heights above the waist, shoulders and neckline from the figure.
Upper upperOf(const Measured& of, double deeper, double wider, double neckOff, double neckDrop) {
  const double waist = of("waist_height"), slope = of("shoulder_slope"), shoulder = of("shoulder_length");
  const double width = of("shoulder_width") / 2;
  // Cloth lies over blades and bust: what the tape along the body has more than the plumb line is added at the top.
  const double frontMore = of("front_waist_length") - (of("neck_front_height") - waist);
  const double backMore = of("back_waist_length") - (of("neck_back_height") - waist);
  const double tip = of("shoulder_height") - waist, neckPoint = tip + shoulder * std::sin(slope);
  Upper upper;
  const auto half = [&](double more, double across, double centre) {
    UpperHalf h;
    h.tip = {width + wider, tip + more - wider * std::tan(slope)};
    h.neck = {width - (shoulder - neckOff) * std::cos(slope), neckPoint + more - neckOff * std::sin(slope)};
    h.across = width - across;
    h.underarm = of("armpit_height") - waist - deeper;
    h.centre = centre;
    return h;
  };
  upper.front = half(frontMore, 0.020, of("neck_front_height") - waist + frontMore - neckDrop);
  upper.back = half(backMore, 0.010, of("neck_back_height") - waist + backMore);
  return upper;
}

// An arm that fills its armhole is pressed in it: under it the armhole is lowered, which a child's and a man's need.
void giveArmRoom(Upper& upper, const Measured& of) {
  constexpr double kRoom = 0.12, kStep = 1e-3, kMost = 0.06;  // metres: of the armhole beyond the arm's girth; down
  const double enough = of("upper_arm_girth") + kRoom;
  for (double down = 0; down < kMost; down += kStep) {
    if (lengthOf(upperHalf(upper.front), "armhole") + lengthOf(upperHalf(upper.back), "armhole") >= enough) return;
    for (UpperHalf* h : {&upper.front, &upper.back}) h->underarm -= kStep;
  }
}

}  // namespace

DraftBand collarBand(std::vector<EdgeRef> neckline, double depth) {
  DraftBand band{"collar", std::move(neckline), depth, 1, 0, {}};
  BodyPoint at;
  at.along = 8.4, at.around = 0.5;  // a little above the base of the neck, behind
  band.at = at;
  return band;
}

Result<Draft> shirtDraft(const Measured& of, const BlockWish& wish) {
  const double ease = wish.ease.value_or(0.12);
  Upper upper = upperOf(of, 0.03, 0.01, 0.025, 0.04);
  const Measured::Belly belly = of.belly();
  const double below = wish.length.value_or(0.26 + belly.belowWaist);
  const double widest = std::fmax(std::fmax(of("bust_girth"), of("hip_girth") - 0.06), belly.girth) + ease;
  for (UpperHalf* h : {&upper.front, &upper.back}) {
    h->hem = -below;
    h->chestWidth = h->hemWidth = widest / 4;
    h->waistWidth = widest / 4 - 0.01;
  }
  if (wish.armhole) giveArmRoom(upper, of);
  const auto front = upperHalf(upper.front), back = upperHalf(upper.back);
  auto sleeves = sleeveDraft(of, {0.08, {}}, {lengthOf(front, "armhole"), lengthOf(back, "armhole")});
  if (!sleeves) return sleeves.error();
  if (Done done = of.enough(); !done) return done.error();

  Draft draft;
  DraftPiece left{"front_left", halfOf(front), {}, {}, {}, {}};
  left.stands.at = torsoWaist(0), left.stands.ease = 0.02;
  DraftPiece behind{"back", wholeOf(back, "_right", "_left"), {}, {}, {}, {}};
  behind.stands.at = torsoWaist(0.5), behind.stands.ease = 0.02;
  draft.pieces = {left, {"front_right", {}, {}, {}, {}, "front_left"}, behind};
  draft.pieces.insert(draft.pieces.end(), sleeves->pieces.begin(), sleeves->pieces.end());
  draft.seams = {{"opening", {draftedEdge("front_left", "centre")}, {draftedEdge("front_right", "centre")}}};
  for (const std::string side : {"left", "right"}) {
    const std::string f = "front_" + side;
    draft.seams.push_back(
        {"shoulder_" + side, {draftedEdge(f, "shoulder")}, {draftedEdge("back", "shoulder_" + side)}});
    draft.seams.push_back({"side_" + side, {draftedEdge(f, "side")}, {draftedEdge("back", "side_" + side)}});
    std::vector<EdgeRef> armhole{draftedEdge(f, "armhole"), draftedEdge("back", "armhole_" + side)};
    std::vector<EdgeRef> cap{draftedEdge("sleeve_" + side, "cap_back"), draftedEdge("sleeve_" + side, "cap_front")};
    if (side == "right") std::reverse(armhole.begin(), armhole.end()), std::reverse(cap.begin(), cap.end());
    draft.seams.push_back({"armhole_" + side, cap, armhole});
  }
  draft.seams.insert(draft.seams.end(), sleeves->seams.begin(), sleeves->seams.end());
  draft.bands = {collarBand({draftedEdge("front_right", "neck"), draftedEdge("back", "neck_right"),
                             draftedEdge("back", "neck_left"), draftedEdge("front_left", "neck")},
                            0.035)};
  return draft;
}

Armhole bodiceArmhole(const Measured& of, const BlockWish& wish) {
  Upper upper = upperOf(of, 0.02, 0, 0.035, 0.05);
  upper.front.chestWidth = upper.back.chestWidth = (of("bust_girth") + 0.06) / 4;
  if (wish.armhole) giveArmRoom(upper, of);
  return {lengthOf(upperHalf(upper.front), "armhole"), lengthOf(upperHalf(upper.back), "armhole")};
}

Result<Draft> bodiceDraft(const Measured& of, const BlockWish& wish) {
  const double ease = wish.ease.value_or(0.06);
  Upper upper = upperOf(of, 0.02, 0, 0.035, 0.05);
  const double chest = (of("bust_girth") + ease) / 4, waist = (of("waist_girth") + ease * 0.7) / 4;
  const double less = std::fmax(0, chest - waist), atSide = std::fmin(0.02, 0.4 * less);
  const double dart = less - atSide;
  const double below = wish.length.value_or(0);
  for (UpperHalf* h : {&upper.front, &upper.back}) {
    h->hem = -below;
    h->chestWidth = chest;
    h->waistWidth = chest - atSide;
    h->hemWidth = h->waistWidth;
  }
  if (wish.armhole) giveArmRoom(upper, of);
  const auto front = upperHalf(upper.front), back = upperHalf(upper.back);
  if (Done done = of.enough(); !done) return done.error();
  Draft draft;
  DraftPiece before{"front", wholeOf(front, "_left", "_right"), {}, {}, {}, {}};
  before.stands.at = torsoWaist(0), before.stands.ease = 0.02;
  DraftPiece behind{"back", wholeOf(back, "_right", "_left"), {}, {}, {}, {}};
  behind.stands.at = torsoWaist(0.5), behind.stands.ease = 0.02;
  draft.pieces = {before, behind};
  const double point = of("bust_span") / 2, high = of("bust_height") - of("waist_height");
  if (dart > 0.005)
    for (const bool plus : {true, false}) {
      const double side = plus ? 1 : -1, place = point / upper.front.waistWidth;
      const auto share = [&](double u) { return plus ? u : 1 - u; };
      draft.darts.push_back({"front",
                             plus ? "hem_left" : "hem_right",
                             share(place),
                             dart,
                             {side * point, std::fmax(0.05, high - 0.025)},
                             "dart"});
      draft.darts.push_back({"back",
                             plus ? "hem_right" : "hem_left",
                             share(0.5),
                             dart,
                             {side * 0.5 * upper.back.waistWidth, std::fmax(0.05, high - 0.02)},
                             "dart"});
    }
  for (const std::string side : {"left", "right"}) {
    draft.seams.push_back(
        {"shoulder_" + side, {draftedEdge("front", "shoulder_" + side)}, {draftedEdge("back", "shoulder_" + side)}});
    draft.seams.push_back(
        {"side_" + side, {draftedEdge("front", "side_" + side)}, {draftedEdge("back", "side_" + side)}});
  }
  return draft;
}

}  // namespace karinui
