// Neck, shoulder points, and the tapes from the neck to the waist.
#include <numbers>

#include "body/anthropometry/survey.h"

namespace karinui {

namespace {

// --- The pit of the neck: the deepest place of the front between chest and chin
constexpr double kPitFrom = 0.06;  // above the armpit
constexpr double kPitTo = 0.89, kPitStep = 0.003;
constexpr double kChinOut = 0.03;  // before the pit: the chin
constexpr double kNapeAbovePit = 0.015;

// --- The neck's own tape, in a plane that falls forwards; a man's and a woman's, between them by the bosom. Measured
// on bodies whose joints are known.
constexpr Vec3 kNeckNormal{0, 0.935, 0.355};
constexpr double kNeckBelowCrownMan = 0.1165, kNeckBelowCrownWoman = 0.1303;
// A child's head is larger: by as much as its pit of the neck lies lower than an adult's, who has it above
// kPitOfAdults.
constexpr double kUsualPit = 0.172, kPitOfAdults = 0.178, kPitOfChildren = 0.190;  // below the crown
constexpr double kNeckBehindJointMan = 0.0120, kNeckBehindJointWoman = 0.0118;

// --- Its base
constexpr double kBaseReach = 0.052;    // from the plane of symmetry: beyond, the plane runs into the shoulders
constexpr double kSideByRadius = 1.05;  // of the neck's radius: where its side runs out into the shoulder
constexpr double kUsualSide = 0.038;    // from the plane of symmetry, where the neck's girth is unknown

constexpr double kShoulderPointOut = 0.0145;  // of the shoulder joint
constexpr int kMidlineSteps = 40;

// A taut tape down the plane of symmetry, from a place to a level, in front or behind.
double tautMidline(const Survey& body, Vec3 from, double to, bool behind) {
  std::vector<Flat> points;
  const double sign = behind ? -1 : 1;
  Interval lean;
  for (int i = 0; i <= kMidlineSteps; ++i) {
    const SagittalProfile profile = profileAt(body, std::lerp(from.y, to, double(i) / kMidlineSteps));
    const Vec3 p = behind ? profile.back : profile.front;
    if (std::abs(p.z) > 1e8) return 0;
    points.push_back({p.y, sign * p.z});
    lean.include(sign * p.z);
  }
  // Two points a metre inside close the hull; what of it lies outside is the tape.
  const Flat first = points.front(), last = points.back();
  points.push_back({first.u, lean.low - 1}), points.push_back({last.u, lean.low - 1});
  const auto hull = convexHull(points);
  double sum = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Flat a = hull[i], b = hull[(i + 1) % hull.size()];
    if (a.v > lean.low - 0.5 && b.v > lean.low - 0.5) sum += distance(a, b);
  }
  return sum;
}

std::optional<Vec3> pitOfNeck(const Survey& body) {
  Vec3 pit{0, 0, 1e9};
  for (double y = body.armpit + kPitFrom * body.stature; y < body.floor + kPitTo * body.stature;
       y += kPitStep * body.stature) {
    const Vec3 front = profileAt(body, y).front;
    if (front.z < -1e8) break;
    if (front.z < pit.z) pit = front;
    if (front.z > pit.z + kChinOut * body.stature) break;
  }
  return pit.z > 1e8 ? std::nullopt : std::optional(pit);
}

// In the plane through pit and nape.
void measureNeckBase(Survey& body, Vec3 pit, Vec3 nape) {
  const Vec3 lie = normalized(cross(nape - pit, Vec3{1, 0, 0})) * -1.0;
  const Vec3 up = lie.y > 0 ? lie : -lie, middle = lerp(pit, nape, 0.5);
  const auto contour = contourNear(body.mesh, middle, up, middle);
  if (!contour) return;
  std::vector<Vec3> ring;
  for (const Vec3& p : contour->points)
    if (std::abs(p.x - body.middle) < kBaseReach * body.stature) ring.push_back(p);
  if (ring.size() > 3) body.set("neck_base_girth", tightTapeLength(ring, up));
}

}  // namespace

SagittalProfile profileAt(const Survey& body, double y) {
  const double middle = body.middle;
  SagittalProfile out{{middle, y, -1e9}, {middle, y, 1e9}};
  for (const SectionLoop& contour : body.slices.section(y))
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const Vec3 a = contour.points[i], b = contour.points[(i + 1) % contour.points.size()];
      if ((a.x > middle) == (b.x > middle)) continue;
      const double z = lerp(a, b, (middle - a.x) / (b.x - a.x)).z;
      out.front.z = std::max(out.front.z, z), out.back.z = std::min(out.back.z, z);
    }
  return out;
}

std::optional<Vec3> highestAt(const Survey& body, double x, double below) {
  std::optional<Vec3> best;
  for (const SectionLoop& contour : section(body.mesh, {{x, 0, 0}, {1, 0, 0}}))
    for (const Vec3& p : contour.points)
      if (p.y <= below && (!best || p.y > best->y)) best = p;
  return best;
}

void measureNeck(Survey& body) {
  const double stature = body.stature;
  const auto pit = pitOfNeck(body);
  if (!pit) return;
  const SagittalProfile atNape = profileAt(body, pit->y + kNapeAbovePit * stature);
  auto& landmark = body.found.landmark;
  landmark["neck_front"] = *pit;
  landmark["neck_back"] = atNape.back;
  body.set("neck_back_height", body.aboveFloor(atNape.back.y));
  body.set("neck_front_height", body.aboveFloor(pit->y));
  const auto& arm = body.found.arm[0];
  const double z = arm ? arm->top.z - std::lerp(kNeckBehindJointMan, kNeckBehindJointWoman, body.bosom) * stature
                       : (atNape.front.z + atNape.back.z) / 2;
  const double low = 1 - body.aboveFloor(pit->y) / stature,
               young = std::clamp((low - kPitOfAdults) / (kPitOfChildren - kPitOfAdults), 0.0, 1.0),
               down = std::lerp(kNeckBelowCrownMan, kNeckBelowCrownWoman, body.bosom) + young * (low - kUsualPit);
  const Vec3 through{body.middle, body.floor + stature * (1 - down), z}, normal = normalized(kNeckNormal);
  double side = kUsualSide * stature;
  if (const auto contour = contourNear(body.mesh, through, normal, through)) {
    const double girth = tightTapeLength(contour->points, normal);
    body.set("neck_girth", girth);
    body.set("neck_height", body.aboveFloor(through.y));
    side = kSideByRadius * girth / (2 * std::numbers::pi);
  }
  measureNeckBase(body, *pit, atNape.back);
  for (const int s : {0, 1})  // above the side points is the head
    if (const auto p = highestAt(body, body.middle + outward(s) * side, through.y)) landmark[sided("neck", s)] = *p;
}

void measureShoulders(Survey& body) {
  auto& landmark = body.found.landmark;
  const auto& arm = body.found.arm;
  for (const int side : {0, 1}) {
    if (!arm[side]) return;
    const Vec3 joint = arm[side]->top;
    const auto top = highestAt(body, joint.x + outward(side) * kShoulderPointOut * body.stature);
    if (!top) return;
    landmark[sided("shoulder", side)] = *top;
    landmark[sided("armpit", side)] = {body.middle + outward(side) * armpitGap(body, side), body.armpit, joint.z};
  }
  const Vec3 point = landmark.at("shoulder_left");
  body.set("shoulder_width", distance(point, landmark.at("shoulder_right")));
  body.set("shoulder_height", body.aboveFloor(point.y));
  body.set("shoulder_joint_width", distance(arm[0]->top, arm[1]->top));
  body.set("arm_length", distance(point, arm[0]->middle) + distance(arm[0]->middle, arm[0]->end));
  if (const auto neck = landmark.find("neck_left"); neck != landmark.end()) {
    const Vec3 along = point - neck->second;
    body.set("shoulder_length", length(along));
    body.set("shoulder_slope", std::atan2(-along.y, std::hypot(along.x, along.z)));
  }
}

void measureWaistLengths(Survey& body) {
  const auto& landmark = body.found.landmark;
  if (const auto it = landmark.find("neck_back"); it != landmark.end())
    body.set("back_waist_length", tautMidline(body, it->second, body.waist, true));
  if (const auto it = landmark.find("neck_front"); it != landmark.end())
    body.set("front_waist_length", tautMidline(body, it->second, body.waist, false));
}

}  // namespace karinui
