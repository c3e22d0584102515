// Limbs taken in hand: the place follows the pointer on a sphere about its joint.
#include "karinui/body/reach.h"
#include "karinui/base/number.h"
#include "karinui/body/sizes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace karinui {
namespace {

const std::shared_ptr<const Skeleton>& skeleton() {
  static const auto made = [] {
    Workers workers(1);
    return Skeleton::of(makeMannequin(builtInSize("jis9ar").value(), workers, Token{}).value()).value();
  }();
  return made;
}

SurfacePoint skin(const char* text) { return skeleton()->body()->find(parseBodyPoint(text).value()).value(); }

Vec3 placeIn(const BodyPose& pose, const SurfacePoint& place) {
  return at({skeleton()->points(skeleton()->placements(pose)), skeleton()->body()->mesh().faces}, place);
}

double offRay(Vec3 p, Vec3 origin, Vec3 direction) {
  const Vec3 off = p - origin;
  return length(off - direction * dot(off, direction));
}

TEST(Reach, WhatIsTakenHoldOfHangsOnItsJoint) {
  const auto holding = [](const char* text) { return jointHolding(*skeleton()->body(), skin(text)); };
  EXPECT_EQ(holding("left_arm:wrist+0.5@0.25"), Joint::LeftShoulder);
  EXPECT_EQ(holding("right_arm:elbow+0.5@0.25"), Joint::RightElbow);
  EXPECT_EQ(holding("right_arm:armpit+0.5@0.75"), Joint::RightShoulder);
  EXPECT_EQ(holding("left_leg:crotch+0.5@0"), Joint::LeftHip);
  EXPECT_EQ(holding("right_leg:knee+0.5@0"), Joint::RightKnee);
  EXPECT_EQ(holding("right_leg:ankle+0.5@0.1"), Joint::RightHip);
  EXPECT_EQ(holding("torso:chin+0.5@0"), Joint::Neck);
  EXPECT_FALSE(holding("torso:waist@0"));
  // Every place of the skin has an answer, those between fingers and toes too: far out on a limb none is the trunk's.
  const TriangleMesh& mesh = skeleton()->body()->mesh();
  const double wrist = skeleton()->place(Joint::LeftWrist).x;
  for (std::uint32_t f = 0; f < mesh.faces.size(); f += 7) {
    const SurfacePoint place{f, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    const Vec3 p = at(mesh, place);
    if (p.x <= wrist + 0.02 && p.y >= 0.03) continue;
    EXPECT_EQ(jointHolding(*skeleton()->body(), place), p.y >= 0.03 ? Joint::LeftShoulder
                                                        : p.x > 0   ? Joint::LeftHip
                                                                    : Joint::RightHip)
        << p.x << " " << p.y;
  }
}

// A pose is asked for by the ray that goes through where the place is in it.
TEST(Reach, ThePlaceFollowsThePointerOnASphereAboutItsJoint) {
  struct Way {
    const char* skin;
    Joint joint;
    JointAngles to;  // degrees
  };
  const Vec3 eye{1.5, 1.3, 4};
  for (const Way& way : {Way{"left_arm:wrist+0.5@0.25", Joint::LeftShoulder, {20, 80, 0}},
                         Way{"right_arm:wrist+0.5@0.25", Joint::RightShoulder, {70, 30, 0}},
                         Way{"left_leg:ankle+0.5@0", Joint::LeftHip, {30, 25, 0}},
                         Way{"right_arm:elbow+0.7@0.25", Joint::RightElbow, {70, 0, 0}},
                         Way{"left_leg:knee+0.7@0", Joint::LeftKnee, {60, 0, 0}}}) {
    const SurfacePoint place = skin(way.skin);
    BodyPose wanted;
    wanted[way.joint] = {way.to.flex * kDegree, way.to.abduct * kDegree, skeleton()->own(way.joint).turn};
    const Vec3 there = placeIn(wanted, place), ray = normalized(there - eye);
    const BodyPose found = reaching(*skeleton(), {}, way.joint, place, eye, ray);
    const Vec3 here = placeIn(found, place);
    EXPECT_LT(offRay(here, eye, ray), 0.001) << way.skin;
    EXPECT_TRUE(withinLimits(found));
    EXPECT_EQ(found.size(), 1u) << "no other joint is touched";
    if (way.joint == Joint::LeftShoulder || way.joint == Joint::RightShoulder) {  // the joint itself stays in place
      const Vec3 centre = skeleton()->place(way.joint);
      EXPECT_NEAR(distance(here, centre), distance(placeIn({}, place), centre), 0.03);
    }
  }
}

TEST(Reach, APointerOutOfReachLeavesTheLimbWithinItsLimits) {
  const SurfacePoint hand = skin("left_arm:wrist+0.5@0.25"), forearm = skin("left_arm:elbow+0.7@0.25");
  const Vec3 eye{0, 1.2, 4};
  // Far out at the left: the arm is level, its hand the nearest it can be.
  const Vec3 ray = normalized(Vec3{2.5, skeleton()->place(Joint::LeftShoulder).y, 0} - eye);
  const BodyPose out = reaching(*skeleton(), {}, Joint::LeftShoulder, hand, eye, ray);
  EXPECT_TRUE(withinLimits(out));
  const double least = offRay(placeIn(out, hand), eye, ray);
  for (double a = 40; a <= 140; a += 5)
    for (double f = -40; f <= 80; f += 10) {
      BodyPose other;
      other[Joint::LeftShoulder] = {f * kDegree, a * kDegree, 0};
      EXPECT_GT(offRay(placeIn(other, hand), eye, ray), least - 0.002) << f << " " << a;
    }
  // An elbow does not bend backwards.
  const Vec3 behind = normalized(placeIn({}, forearm) + Vec3{0, 0, -0.4} - Vec3{3, 1.2, 0});
  const BodyPose bent = reaching(*skeleton(), {}, Joint::LeftElbow, forearm, {3, 1.2, 0}, behind);
  EXPECT_TRUE(withinLimits(bent));
  EXPECT_NEAR(bent.at(Joint::LeftElbow).flex, -5 * kDegree, 1e-6);
}

}  // namespace
}  // namespace karinui
