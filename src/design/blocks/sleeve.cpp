#include <cmath>

#include "design/blocks/draft.h"

namespace karinui {

namespace {

// The cap from the underarm at the back over the crown to the underarm in front.
Curve capOf(double half, double height, bool back) {
  // The front is hollowed more than the back.
  const double low = back ? 0.40 : 0.50, high = 0.55;
  const Curve curve = Curve::cubic({half, 0}, {half * (1 - low), 0}, {half * high, height}, {0, height});
  return back ? curve : curve.mirrored({0, 0}, {0, 1}).reversed();
}
double capLength(double half, double height) {
  return capOf(half, height, true).length() + capOf(half, height, false).length();
}

constexpr double kWing = 1.08;  // times the crown of a sleeve that is set in: higher ones stand up beside the shoulder

// How high the crown of a sleeve that is set in may be: a third of the armhole's length, but lower for one that is long
// for its arm, as armholes are that scoop far into the chest or reach far down. An armhole of 45 cm for an arm of 28 cm
// takes a crown of 15 cm, one of 61 cm a crown of 12: sleeves with higher ones stood up beside the shoulder.
double setInCrown(double round, double arm) { return std::fmin(round / 3, 0.84 * arm - 0.19 * round); }

// Half the width at which a crown of that height fills an armhole.
double halfFor(double wanted, double height) {
  double low = 0.02, high = wanted;
  for (int i = 0; i < 60; ++i) {
    const double half = 0.5 * (low + high);
    (capLength(half, height) < wanted ? low : high) = half;
  }
  return low;
}

}  // namespace

Result<Draft> sleeveDraft(const Measured& of, const BlockWish& wish, Armhole armhole) {
  const double girth = of("upper_arm_girth") + wish.ease.value_or(0.06), half = girth / 2;
  const double wanted = (armhole.front + armhole.back) * 1.015;
  // The crown is as high as makes the cap fill the armhole, 1.5 % eased in.
  double low = 0.02, high = 0.30;
  for (int i = 0; i < 60; ++i) {
    const double height = 0.5 * (low + high);
    (capLength(half, height) < wanted ? low : high) = height;
  }
  const double crown = low;
  const double whole = wish.length.value_or(of("arm_length") + 0.01), below = whole - crown;
  const double cuff = (of("wrist_girth") + 0.08) / 2;
  if (Done done = of.enough(); !done) return done.error();
  if (!(below > 0.02))
    return refused(say("A sleeve that long ends above the underarm; it has to be longer than {0} cm.",
                       std::round((crown + 0.02) * 100)));
  // A shorter sleeve is cut off the long one.
  const double full = std::fmax(of("arm_length") + 0.01 - crown, below);
  const double foot = std::lerp(half, std::fmin(half, cuff), below / full);
  Draft draft;
  const double round = armhole.front + armhole.back;
  if (const double least = std::fmax(setInCrown(round, of("upper_arm_girth")), 0.05); crown > kWing * least) {
    const auto cm = [](double metres) { return std::round(metres * 100); };
    draft.advice = say(
        "The armhole is {0} cm round, and the sleeve {1} cm wide: its crown is {2} cm high and will stand up beside "
        "the shoulder. For a sleeve as wide as such an armhole asks for, state ease={3}cm.",
        cm(round), cm(girth), cm(crown), cm(2 * halfFor(wanted, least) - of("upper_arm_girth")));
  }
  DraftPiece left;
  left.name = "sleeve_left";
  left.outline.edges = {{"hem", Curve::line({-foot, -below}, {foot, -below})},
                        {"under_back", Curve::line({foot, -below}, {half, 0})},
                        {"cap_back", capOf(half, crown, true)},
                        {"cap_front", capOf(half, crown, false)},
                        {"under_front", Curve::line({-half, 0}, {-foot, -below})}};
  BodyPoint at;
  at.part = BodyPoint::Part::LeftArm, at.along = 1.15, at.around = 0.25;
  left.stands.at = at, left.stands.ease = 0.008, left.stands.taper = true;
  draft.pieces = {left, {"sleeve_right", {}, {}, {}, {}, "sleeve_left"}};
  for (const std::string side : {"left", "right"}) {
    const PieceRef sleeve("sleeve_" + side);
    draft.seams.push_back({"underarm_" + side, {{sleeve, "under_back"}}, {{sleeve, "under_front"}}});
  }
  return draft;
}

}  // namespace karinui
