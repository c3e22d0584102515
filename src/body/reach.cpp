#include "karinui/body/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "karinui/geometry/mesh.h"

namespace karinui {

namespace {

constexpr int kReachRounds = 30;
constexpr double kStep = 1e-4;                              // radians: of the differences
constexpr double kLongest = 0.35;                           // radians: of one round
constexpr double kEnough = 1e-5;                            // radians: a round that moves less is the last
constexpr double kFarthest = 176 * std::numbers::pi / 180;  // of a ball joint from hanging, as withinLimits() has it

struct LimbChain {
  BodyPoint::Part part;
  Joint root, middle;  // the joint at the trunk, and the hinge
  double hinge, end;   // levels of the chart: where the hinge is, and where hand or foot begin
};
constexpr std::array kLimbs{
    LimbChain{BodyPoint::Part::LeftArm, Joint::LeftShoulder, Joint::LeftElbow, 2, 3},
    LimbChain{BodyPoint::Part::RightArm, Joint::RightShoulder, Joint::RightElbow, 2, 3},
    LimbChain{BodyPoint::Part::LeftLeg, Joint::LeftHip, Joint::LeftKnee, 1, 2},
    LimbChain{BodyPoint::Part::RightLeg, Joint::RightHip, Joint::RightKnee, 1, 2},
};
constexpr double kNeck = 9;  // level of the trunk above which the head begins

bool hasAbduct(Joint joint) {
  const JointLimits limits = limitsOf(joint);
  return limits.most.abduct > limits.least.abduct;
}

JointAngles limited(Joint joint, JointAngles angles) {
  const auto [least, most] = limitsOf(joint);
  angles.flex = std::clamp(angles.flex, least.flex, most.flex);
  angles.abduct = std::clamp(angles.abduct, least.abduct, most.abduct);
  if (const double far = std::hypot(angles.flex, angles.abduct); far > kFarthest)
    angles.flex *= kFarthest / far, angles.abduct *= kFarthest / far;
  return angles;
}

}  // namespace

std::optional<Joint> jointHolding(const Body& body, const SurfacePoint& place) {
  const Body& own = body.own();
  const BodyPoint point = own.describe(place);
  if (point.part == BodyPoint::Part::Torso) return point.along >= kNeck ? std::optional(Joint::Neck) : std::nullopt;
  for (const LimbChain& limb : kLimbs)
    if (point.part == limb.part) return point.along > limb.hinge && point.along < limb.end ? limb.middle : limb.root;
  // Between fingers and toes the chart has no place: they belong to the limb whose end is nearest.
  std::optional<Joint> nearest;
  double least = 1e9;
  for (const LimbChain& limb : kLimbs) {
    BodyPoint near;
    near.part = limb.part, near.along = limb.end + 0.2;
    if (const auto end = own.find(near))
      if (const double away = distance(at(own.mesh(), *end), at(own.mesh(), place)); away < least)
        least = away, nearest = limb.root;
  }
  return nearest;
}

BodyPose reaching(const Skeleton& skeleton, const BodyPose& from, Joint joint, const SurfacePoint& place, Vec3 origin,
                  Vec3 direction) {
  const Triangle& face = skeleton.body()->mesh().faces[place.face];
  const std::vector<Vec3>& own = skeleton.body()->mesh().points;
  const std::size_t unknowns = hasAbduct(joint) ? 2 : 1;
  BodyPose pose = from;
  JointAngles& angles = pose.try_emplace(joint, skeleton.own(joint)).first->second;
  // From the ray to the place, at right angles to the ray.
  const auto miss = [&](const JointAngles& tried) {
    angles = tried;
    const std::vector<Rigid> placements = skeleton.placements(pose);
    Vec3 there;
    for (int k = 0; k < 3; ++k) there += placements[face[k]](own[face[k]]) * place.weight[k];
    const Vec3 off = there - origin;
    return off - direction * dot(off, direction);
  };
  JointAngles best = angles;
  Vec3 off = miss(best);
  double damping = 1e-3;
  for (int round = 0; round < kReachRounds; ++round) {
    std::array<Vec3, 2> slope{};
    for (std::size_t k = 0; k < unknowns; ++k) {
      JointAngles tried = best;
      (k == 0 ? tried.flex : tried.abduct) += kStep;
      slope[k] = (miss(tried) - off) * (1 / kStep);
    }
    const double a = dot(slope[0], slope[0]), b = dot(slope[0], slope[1]), c = dot(slope[1], slope[1]);
    // The slopes turn with the joint, by no more than the lever's length a radian: that much the miss itself may count.
    const double lever = std::sqrt(std::max(a, c));
    const double damped = damping * lever * lever + length(off) * lever + 1e-12;
    const double f = -dot(slope[0], off), g = -dot(slope[1], off);
    const double by = (a + damped) * (c + damped) - b * b;
    std::array<double, 2> step{((c + damped) * f - b * g) / by, ((a + damped) * g - b * f) / by};
    if (unknowns == 1) step = {f / (a + damped), 0};
    const double far = std::hypot(step[0], step[1]);
    const double share = std::min(1.0, kLongest / std::max(far, 1e-12));
    const JointAngles tried = limited(joint, {best.flex + share * step[0], best.abduct + share * step[1], best.turn});
    const Vec3 then = miss(tried);
    if (squaredLength(then) >= squaredLength(off)) {
      damping *= 10;
      continue;
    }
    const double moved = std::hypot(tried.flex - best.flex, tried.abduct - best.abduct);
    best = tried, off = then, damping = std::max(1e-6, damping / 10);
    if (moved < kEnough) break;
  }
  angles = best;
  if (angles == skeleton.own(joint)) pose.erase(joint);
  return pose;
}

}  // namespace karinui
