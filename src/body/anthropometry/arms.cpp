// One arm: its sections from armpit to fingertips, its joints, girths and lengths.
#include "body/anthropometry/extremum.h"
#include "body/anthropometry/survey.h"

namespace karinui {

namespace {

// --- The faces an arm's sections meet
constexpr double kArmOut = 0.045, kArmAbove = 0.3;  // from the plane of symmetry; above the floor

// --- Following the arm
constexpr double kStartBelow = 0.012, kStartOut = 0.08;  // of the first section: below the armpit, off the trunk
constexpr double kLeastLine = 0.07;                      // of its contour: else a finger, or a sliver
constexpr Vec3 kFirstWay{0.67, -0.74, 0};                // of an arm in A-pose, the left one
constexpr double kStep = 0.006;
constexpr int kMostSteps = 90, kFewestSteps = 30;
constexpr double kLeap = 0.035;       // of the centre from one section to the next: it has left the arm
constexpr double kSwelling = 1.6;     // of the girth from one section to the next: likewise
constexpr double kTipGirth = 0.02;    // at less the fingertips are reached
constexpr std::size_t kLookBack = 7;  // sections over which the way is taken
constexpr double kInertia = 0.6;      // of the way before

// --- Wrist and elbow, by the number of the section
constexpr double kHandGirth = 1.15;                            // of the wrist's: the hand has begun
constexpr double kForearmLeast = 0.105, kForearmMost = 0.165;  // length
constexpr int kLineFitRounds = 20;

// The flesh does not lie evenly around the bones. How far a joint stands from the middle of the flesh was measured on
// bodies whose joints are known, men's and women's (between them by the bosom); these shifts are what makes a joint an
// estimate, good to about 5 mm. Arms thicker than kUsualThickness carry more flesh outside.
constexpr double kElbowBack = 0.0062, kElbowUp = 0.0065;  // a man's elbow, a woman's elbow
constexpr double kThicknessAbove = 0.0755;                // the elbow: there the thickness (a girth) is taken
constexpr double kUsualThickness = 0.1667;
constexpr double kWristDownMan = 0.0048, kWristDownWoman = 0.0013, kWristByThickness = 0.05;
constexpr double kShoulderOutMan = 0.0043, kShoulderOutWoman = -0.0013, kShoulderByThickness = -0.130;
constexpr double kShoulderUp = 0.0055, kShoulderFrontMan = 0.0142, kShoulderFrontWoman = 0.0065;
constexpr double kLeastSpread = 0.2;  // x of the upper arm's direction: a hanging arm does not cross the joint's x
constexpr double kLeastBend = 1e-4;   // 1 - cos^2 between upper arm and forearm: straight arms have no nearest points

// --- Where the tape is laid
constexpr double kUpperArmTape = 0.47;     // of the way from shoulder joint to elbow
constexpr double kWristTapeAbove = 0.010;  // metres above the narrowest place

struct Ring {  // one section of the arm
  Vec3 centre, direction;
  double girth = 0;
};

// The trunk's side is cut open, but an arm's own contour is whole: quicker to cut than all of the body.
TriangleMesh armFaces(const Survey& body, int side) {
  const double sign = outward(side);
  std::vector<std::uint32_t> faces, renumbered;
  for (std::uint32_t f = 0; f < body.mesh.faces.size(); ++f)
    for (const std::uint32_t p : body.mesh.faces[f])
      if (sign * (body.mesh.points[p].x - body.middle) > kArmOut * body.stature &&
          body.mesh.points[p].y > body.floor + kArmAbove * body.stature) {
        faces.push_back(f);
        break;
      }
  return compacted(body.mesh, faces, renumbered);
}

std::optional<Vec3> firstCentre(const Survey& body, int side) {
  std::optional<Vec3> found;
  for (const SectionLoop& contour : body.slices.section(body.armpit - kStartBelow * body.stature)) {
    const Vec3 c = contourCentre(contour);
    if (outward(side) * (c.x - body.middle) > kStartOut * body.stature &&
        lineLength(contour.points, true) > kLeastLine * body.stature)
      found = c;
  }
  return found;
}

// From the armpit to the fingertips, each plane across the way the last ones went.
std::vector<Ring> traceArm(const Survey& body, const TriangleMesh& mesh, int side) {
  std::vector<Ring> way;
  const auto first = firstCentre(body, side);
  if (!first) return way;
  Vec3 here = *first, going = normalized(Vec3{kFirstWay.x * outward(side), kFirstWay.y, kFirstWay.z});
  const double step = kStep * body.stature;
  for (int i = 0; i < kMostSteps; ++i) {
    const auto contour = contourNear(mesh, here, going, here);
    if (!contour) break;
    const Vec3 c = contourCentre(*contour);
    const double girth = tightTapeLength(contour->points, going);
    if (distance(c, here) > kLeap * body.stature || (way.size() > 5 && girth > kSwelling * way.back().girth)) break;
    way.push_back({c, going, girth});
    const std::size_t n = way.size();
    if (n > kLookBack + 1)
      going = normalized(going * kInertia + normalized(c - way[n - kLookBack].centre) * (1 - kInertia));
    here = c + going * step;
    if (girth < kTipGirth * body.stature) break;
  }
  return way;
}

struct Line {
  Vec3 through, along;
  double error = 0;  // the sum of the squared distances
};

// The least-squares line through the centres of sections from ... to - 1.
Line lineThrough(const std::vector<Ring>& way, std::size_t from, std::size_t to) {
  Vec3 mean;
  for (std::size_t i = from; i < to; ++i) mean += way[i].centre;
  mean *= 1.0 / static_cast<double>(to - from);
  Vec3 along = normalized(way[to - 1].centre - way[from].centre);
  for (int round = 0; round < kLineFitRounds; ++round) {  // power iteration on the scatter matrix
    Vec3 next;
    for (std::size_t i = from; i < to; ++i) next += (way[i].centre - mean) * dot(way[i].centre - mean, along);
    along = normalized(next);
  }
  Line line{mean, along, 0};
  for (std::size_t i = from; i < to; ++i) {
    const Vec3 d = way[i].centre - mean;
    line.error += squaredLength(d - along * dot(d, along));
  }
  return line;
}

// The narrowest section between forearm and hand.
std::size_t wristOf(const std::vector<Ring>& way) {
  std::size_t wrist = way.size() * 3 / 10;
  for (std::size_t i = wrist; i < way.size() * 9 / 10; ++i) {
    if (way[i].girth < way[wrist].girth) wrist = i;
    if (way[i].girth > kHandGirth * way[wrist].girth) break;  // the fingertips are narrow again
  }
  return wrist;
}

// Its centre, refined between the sections beside it.
Vec3 narrowestPlace(const std::vector<Ring>& way, std::size_t wrist) {
  const double between =
      wrist + 1 < way.size() ? parabolaPeak(1, way[wrist - 1].girth, way[wrist].girth, way[wrist + 1].girth) : 0;
  return between < 0 ? lerp(way[wrist].centre, way[wrist - 1].centre, -between)
                     : lerp(way[wrist].centre, way[std::min(wrist + 1, way.size() - 1)].centre, between);
}

// The section at which two straight lines through the centres above and below it fit best; 0: none.
std::size_t elbowOf(const std::vector<Ring>& way, std::size_t wrist, double stature) {
  std::size_t elbow = 0;
  double least = 1e9;
  for (std::size_t s = 5; s + 10 < wrist; ++s) {
    const double forearm = distance(way[s].centre, way[wrist].centre) / stature;
    if (forearm < kForearmLeast || forearm > kForearmMost) continue;
    const double error = lineThrough(way, 1, s).error + lineThrough(way, s, wrist).error;
    if (error < least) least = error, elbow = s;
  }
  return elbow;
}

struct Bones {
  LimbAxis axis;
  Vec3 upper, fore;      // directions
  Vec3 foreThrough;      // a point of the forearm's line
  double narrowest = 0;  // of the wrist, along that line
};

std::optional<Bones> bonesOf(const Survey& body, const TriangleMesh& mesh, const std::vector<Ring>& way, int side) {
  const double stature = body.stature, sign = outward(side);
  const std::size_t wrist = wristOf(way), elbow = elbowOf(way, wrist, stature);
  if (elbow == 0) return std::nullopt;
  const Vec3 narrow = narrowestPlace(way, wrist);
  const Line upper = lineThrough(way, elbow > 10 ? 2 : 1, std::max<std::size_t>(elbow - 4, 5)),
             fore = lineThrough(way, elbow + 4, wrist - 1);
  // The elbow lies between the nearest points of the two lines.
  const Vec3 w = upper.through - fore.through;
  const double b = dot(upper.along, fore.along), d = dot(upper.along, w), e = dot(fore.along, w), bend = 1 - b * b;
  if (bend < kLeastBend) return std::nullopt;
  const Vec3 onUpper = upper.through + upper.along * ((b * e - d) / bend);
  const Vec3 onFore = fore.through + fore.along * ((e - b * d) / bend);

  Bones bones{{}, upper.along, fore.along, fore.through, dot(narrow - fore.through, fore.along)};
  LimbAxis& axis = bones.axis;
  axis.middle = lerp(onUpper, onFore, 0.5) - Vec3{0, 0, kElbowBack * stature * (1 - body.bosom)} -
                upper.along * (kElbowUp * stature * body.bosom);
  const double thick = tapeAcross(mesh, axis.middle - upper.along * (kThicknessAbove * stature), upper.along) / stature;
  axis.end =
      fore.through + fore.along * (bones.narrowest + stature * (std::lerp(kWristDownMan, kWristDownWoman, body.bosom) +
                                                                kWristByThickness * (thick - kUsualThickness)));
  axis.tip = way.back().centre;
  // The shoulder joint lies on the upper arm's line, above the armpit.
  const double joint = armpitGap(body, side) + stature * (std::lerp(kShoulderOutMan, kShoulderOutWoman, body.bosom) +
                                                          kShoulderByThickness * (thick - kUsualThickness));
  if (std::abs(upper.along.x) < kLeastSpread) return std::nullopt;
  axis.top = upper.through + upper.along * ((body.middle + sign * joint - upper.through.x) / upper.along.x) +
             Vec3{0, kShoulderUp * stature, std::lerp(kShoulderFrontMan, kShoulderFrontWoman, body.bosom) * stature};
  return bones;
}

Vec3 outermostAcross(const TriangleMesh& mesh, Vec3 place, Vec3 normal, int side) {
  const auto contour = contourNear(mesh, place, normal, place);
  return contour ? outermost(*contour, side) : place;
}

}  // namespace

void measureArm(Survey& body, int side) {
  const TriangleMesh mesh = armFaces(body, side);
  const auto way = traceArm(body, mesh, side);
  if (way.size() < kFewestSteps) return;
  const auto bones = bonesOf(body, mesh, way, side);
  if (!bones) return;
  const LimbAxis& axis = bones->axis;
  const Vec3 atElbow = normalized(bones->upper + bones->fore);
  body.found.arm[side] = axis;
  body.found.landmark[sided("elbow", side)] = outermostAcross(mesh, axis.middle, atElbow, side);
  body.found.landmark[sided("wrist", side)] = outermostAcross(mesh, axis.end, bones->fore, side);
  if (side == 1 && body.found.arm[0]) return;  // measured on the left, as a tailor does on one side
  const Vec3 wristTape = bones->foreThrough + bones->fore * (bones->narrowest - kWristTapeAbove);
  const double upperArm = distance(axis.top, axis.middle), forearm = distance(axis.middle, axis.end);
  body.set("upper_arm_girth", tapeAcross(mesh, lerp(axis.top, axis.middle, kUpperArmTape), bones->upper));
  body.set("elbow_girth", tapeAcross(mesh, axis.middle, atElbow));
  body.set("wrist_girth", tapeAcross(mesh, wristTape, bones->fore));
  body.set("upper_arm_length", upperArm);
  body.set("forearm_length", forearm);
  body.set("arm_joint_length", upperArm + forearm);
  body.set("arm_angle", std::atan2(axis.top.y - axis.middle.y, outward(side) * (axis.middle.x - axis.top.x)));
}

}  // namespace karinui
