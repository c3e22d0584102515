// Leg girths, knee and ankle.
#include "body/anthropometry/extremum.h"
#include "body/anthropometry/survey.h"

namespace karinui {

namespace {

constexpr double kLegReach = 0.13;                  // of a leg's centre from the plane of symmetry
constexpr double kThighBelow = 0.03;                // metres below the crotch
constexpr double kKnee = 0.603;                     // of the inside leg
constexpr double kCalfFrom = 0.32, kCalfTo = 0.52;  // of the inside leg
constexpr int kCalfSamples = 14;
constexpr double kAnkle = 0.0598;
constexpr double kHipJointAbove = 0.05;  // the thigh's axis is drawn this far on above where it is measured
constexpr double kLeastThigh = 0.05;     // metres: divides by no less

std::optional<SectionLoop> legContour(const Survey& body, double y, int side) {
  std::optional<SectionLoop> best;
  double most = 0;
  for (SectionLoop& contour : body.slices.section(y)) {
    const double x = (contourCentre(contour).x - body.middle) * outward(side), line = lineLength(contour.points, true);
    if (x > 0 && x < kLegReach * body.stature && line > most) most = line, best = std::move(contour);
  }
  return best;
}

}  // namespace

void measureLegs(Survey& body) {
  const auto girth = [&](double y) {
    const auto contour = legContour(body, y, 0);
    return contour ? tightTapeLength(contour->points, {0, 1, 0}) : 0;
  };
  const double insideLeg = body.aboveFloor(body.crotch);
  const double thigh = body.crotch - kThighBelow, knee = body.floor + kKnee * insideLeg,
               ankle = body.floor + kAnkle * body.stature;
  const GirthLevel calf = extremum(Extremum::Largest, body.floor + kCalfFrom * insideLeg,
                                   body.floor + kCalfTo * insideLeg, kCalfSamples, girth);
  body.set("thigh_girth", girth(thigh));
  body.set("knee_girth", girth(knee)), body.set("knee_height", body.aboveFloor(knee));
  body.set("calf_girth", calf.girth), body.set("calf_height", body.aboveFloor(calf.y));
  body.set("ankle_girth", girth(ankle)), body.set("ankle_height", body.aboveFloor(ankle));
  for (const int side : {0, 1}) {
    const auto top = legContour(body, thigh, side), middle = legContour(body, knee, side),
               end = legContour(body, ankle, side);
    if (!top || !middle || !end) continue;
    LimbAxis axis;
    axis.middle = contourCentre(*middle);
    axis.end = contourCentre(*end);
    const Vec3 upper = contourCentre(*top);
    axis.top = upper +
               (upper - axis.middle) * (kHipJointAbove * body.stature / std::max(kLeastThigh, upper.y - axis.middle.y));
    axis.tip = axis.end;
    axis.tip.y = body.floor;
    body.found.leg[side] = axis;
    body.found.landmark[sided("knee", side)] = foremost(*middle);
    body.found.landmark[sided("ankle", side)] = outermost(*end, side);
  }
}

}  // namespace karinui
