// Figures in poses: what the skin keeps, however the joints are bent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/shapes.h"
#include "karinui/base/number.h"
#include "karinui/body/lines.h"
#include "karinui/body/sizes.h"
#include "karinui/body/skeleton.h"
#include "karinui/geometry/section.h"

namespace karinui {
namespace {

Measurements person(const std::string& name) {
  if (name == "large")
    return {Sex::Female, {{"bust_girth", 1.16}, {"waist_girth", 1.02}, {"hip_girth", 1.22}, {"height", 1.66}}};
  if (name == "folds")
    return {Sex::Female, {{"bust_girth", 0.94}, {"waist_girth", 0.76}, {"hip_girth", 1.01}, {"height", 1.68}}};
  if (name == "child")
    return {Sex::Female, {{"bust_girth", 0.57}, {"waist_girth", 0.52}, {"hip_girth", 0.61}, {"height", 1.10}}};
  return builtInSize(name).value();
}

std::shared_ptr<const Skeleton> skeletonOf(const std::string& name) {  // made once for all tests of this program
  static std::map<std::string, std::shared_ptr<const Skeleton>> all;
  auto& known = all[name];
  if (known) return known;
  Workers workers(1);
  const auto body = makeMannequin(person(name), workers, Token{});
  EXPECT_TRUE(body) << text(body.error().what);
  return known = Skeleton::of(*body).value();
}

TriangleMesh meshIn(const Skeleton& skeleton, const BodyPose& pose) {
  return {skeleton.points(skeleton.placements(pose)), skeleton.body()->mesh().faces};
}

double girthAcross(const TriangleMesh& mesh, Vec3 middle, Vec3 along) {
  double best = 1e9, girth = 0;
  for (const SectionLoop& loop : section(mesh, {middle, along})) {
    Vec3 mean;
    for (const Vec3& p : loop.points) mean += p * (1.0 / static_cast<double>(loop.points.size()));
    if (distance(mean, middle) < best) best = distance(mean, middle), girth = tightTapeLength(loop.points, along);
  }
  EXPECT_LT(best, 0.05);
  return girth;
}

class FigurePose : public testing::TestWithParam<std::tuple<const char*, std::size_t>> {
 protected:
  const NamedPose& pose() const { return namedPoses()[std::get<1>(GetParam())]; }
  std::shared_ptr<const Skeleton> skeleton() const { return skeletonOf(std::get<0>(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(Each, FigurePose,
                         testing::Combine(testing::Values("jis9ar", "eu50", "large", "child"),
                                          testing::Range<std::size_t>(0, 9)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param)) + "_" +
                                  std::string(namedPoses()[std::get<1>(of.param)].name);
                         });

TEST_P(FigurePose, IsAClosedSkinThatStandsOnTheFloorAndDoesNotCrossItself) {
  const auto bones = skeleton();
  const auto wanted = bones->named(pose());
  ASSERT_TRUE(wanted) << text(wanted.error().what);
  EXPECT_TRUE(withinLimits(*wanted));
  const TriangleMesh mesh = meshIn(*bones, *wanted);
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.closed() && report.outward);
  EXPECT_EQ(report.shells, 1u);
  EXPECT_EQ(report.selfCrossings, 0u);
  double low = 1;
  for (const Vec3& p : mesh.points) low = std::min(low, p.y);
  EXPECT_NEAR(low, 0, 1e-9);
  const double own = volume(bones->body()->mesh());
  EXPECT_NEAR(volume(mesh) / own, 1, 0.09);  // raised arms draw the skin of the armpit out
}

TEST_P(FigurePose, KeepsTheGirthsOfLimbsAwayFromJoints) {
  const auto bones = skeleton();
  const auto wanted = bones->named(pose());
  ASSERT_TRUE(wanted);
  const std::vector<Rigid> placements = bones->placements(*wanted);
  const TriangleMesh mesh{bones->points(placements), bones->body()->mesh().faces};
  const auto half = [&](Joint a, Joint b, double share) {
    const Vec3 from = bones->place(a), to = bones->place(b), along = normalized(to - from);
    const Vec3 middle = lerp(from, to, share);
    const auto& own = bones->body()->mesh();
    const double before = girthAcross(own, middle, along);
    // The plane goes with the skin that it cuts.
    const auto near = bones->body()->bvh().nearest(middle);
    const Rigid& way = placements[own.faces[near->place.face][0]];
    EXPECT_NEAR(girthAcross(mesh, way(middle), way.turned(along)) / before, 1, 0.02)
        << jointNames()[static_cast<std::size_t>(a)] << " " << before;
  };
  for (const int side : {0, 1}) {
    const auto of = [&](Joint left) { return static_cast<Joint>(static_cast<int>(left) + side); };
    // A stout arm leaves the trunk half-way to the elbow: nothing of it is away from both joints.
    const Vec3 top = bones->place(of(Joint::LeftShoulder)), elbow = bones->place(of(Joint::LeftElbow));
    const Vec3 armpit = bones->body()->landmarks().at(side ? "armpit_right" : "armpit_left");
    if (dot(armpit - top, elbow - top) < 0.4 * squaredLength(elbow - top))
      half(of(Joint::LeftShoulder), of(Joint::LeftElbow), 0.68);
    half(of(Joint::LeftElbow), of(Joint::LeftWrist), 0.6);
    half(of(Joint::LeftHip), of(Joint::LeftKnee), 0.6);
    half(of(Joint::LeftKnee), of(Joint::LeftAnkle), 0.5);
  }
}

TEST(Pose, TheOwnPoseMovesNothing) {
  const auto bones = skeletonOf("jis9ar");
  for (const Rigid& way : bones->placements({})) ASSERT_EQ(way, Rigid());
  const auto body = posed(*bones, {});
  ASSERT_TRUE(body);
  EXPECT_EQ(*body, bones->body());
  // Said in full it is the same to rounding.
  const TriangleMesh whole = meshIn(*bones, bones->whole({}));
  EXPECT_EQ(whole.points, bones->body()->mesh().points);
}

TEST(Pose, AnArmPointsWhereItsAnglesSay) {
  const auto bones = skeletonOf("eu50");
  for (const auto& [flex, abduct] : {std::pair{0.0, 90.0}, {90.0, 0.0}, {0.0, 20.0}, {60.0, 140.0}, {-30.0, 20.0}}) {
    BodyPose pose;
    pose[Joint::LeftShoulder] = {flex * kDegree, abduct * kDegree, 0};
    const Vec3 top = bones->place(Joint::LeftShoulder), elbow = bones->place(Joint::LeftElbow);
    const auto near = bones->body()->bvh().nearest(lerp(top, elbow, 0.85));
    const std::uint32_t point = bones->body()->mesh().faces[near->place.face][0];
    const Vec3 to = bones->placements(pose)[point].turned(normalized(elbow - top));
    const double raised = std::hypot(flex, abduct) * kDegree;
    const Vec3 wanted{std::sin(raised) * abduct / std::hypot(flex, abduct), -std::cos(raised),
                      std::sin(raised) * flex / std::hypot(flex, abduct)};
    EXPECT_LT(distance(to, wanted), 1e-6) << flex << " " << abduct;
  }
}

TEST(Pose, ABentElbowMovesItsForearmAloneAndByItsAngle) {
  const auto bones = skeletonOf("jis9ar");
  BodyPose pose;
  const double own = bones->own(Joint::LeftElbow).flex;
  pose[Joint::LeftElbow] = {own + 60 * kDegree, 0, 0};
  const std::vector<Rigid> placements = bones->placements(pose);
  const auto& points = bones->body()->mesh().points;
  const Vec3 elbow = bones->place(Joint::LeftElbow), wrist = bones->place(Joint::LeftWrist);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x < elbow.x - 0.1) {
      ASSERT_EQ(placements[i], Rigid()) << i;
    }
    if (distance(points[i], wrist) < 0.05) {
      ASSERT_NEAR(2 * std::acos(std::min(1.0, std::fabs(placements[i].w))), 60 * kDegree, 1e-6);
    }
  }
}

TEST(Pose, AForearmThatIsTurnedKeepsItsGirth) {  // no twisted sweet paper
  const auto bones = skeletonOf("jis9ar");
  BodyPose pose;
  const JointAngles own = bones->own(Joint::LeftElbow);
  pose[Joint::LeftElbow] = {own.flex, 0, 80 * kDegree};
  const TriangleMesh mesh = meshIn(*bones, pose);
  const Vec3 elbow = bones->place(Joint::LeftElbow), wrist = bones->place(Joint::LeftWrist);
  for (const double share : {0.3, 0.5, 0.7}) {
    const Vec3 middle = lerp(elbow, wrist, share), along = normalized(wrist - elbow);
    EXPECT_NEAR(girthAcross(mesh, middle, along) / girthAcross(bones->body()->mesh(), middle, along), 1, 0.02) << share;
  }
}

// However far it is opened, the groin of this one folds through itself at 86 degrees.
TEST(Pose, AFigureThatCannotGoAllTheWayGoesNearlySoFar) {
  const auto bones = skeletonOf("folds");
  const NamedPose& seated = *namedPose("seated");
  const auto pose = bones->named(seated);
  ASSERT_TRUE(pose) << text(pose.error().what);
  EXPECT_TRUE(posed(*bones, *pose));
  EXPECT_LT(pose->at(Joint::LeftKnee).flex, seated.pose.at(Joint::LeftKnee).flex);
  EXPECT_GT(pose->at(Joint::LeftKnee).flex, 75 * kDegree);
}

TEST(Pose, PlacesOnTheBodyGoWithTheSkin) {
  const auto bones = skeletonOf("jis9ar");
  const auto body = posed(*bones, bones->named(*namedPose("seated")).value());
  ASSERT_TRUE(body) << text(body.error().what);
  const Body& own = (*body)->own();
  EXPECT_EQ(&own, bones->body().get());
  test::Numbers numbers(5);
  for (int k = 0; k < 200; ++k) {
    const auto face =
        static_cast<std::uint32_t>(numbers.between(0, 1) * (static_cast<double>(own.mesh().faces.size()) - 1));
    const SurfacePoint place{face, {0.2, 0.3, 0.5}};
    const BodyPoint point = (*body)->describe(place);
    EXPECT_EQ(text(point), text(own.describe(place)));
    const auto found = (*body)->find(point);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(at(own.mesh(), *found), at(own.mesh(), place)), 0.001);
  }
  // Knees are in front of the hips and as high as they, landmarks lie on the skin, measures are those of standing.
  const Vec3 knee = at((*body)->mesh(), (*body)->find(parseBodyPoint("left_leg:knee@0").value()).value());
  const Vec3 waist = at((*body)->mesh(), (*body)->find(parseBodyPoint("torso:waist@0").value()).value());
  EXPECT_GT(knee.z, waist.z + 0.25);
  EXPECT_GT(knee.y, waist.y - 0.35);
  EXPECT_EQ((*body)->landmarks().size(), own.landmarks().size());
  for (const auto& [name, place] : (*body)->landmarks()) {
    const SurfacePoint skin = own.bvh().nearest(own.landmarks().at(name))->place;
    EXPECT_LT(distance(place, at((*body)->mesh(), skin)), 1e-9) << name;
  }
  EXPECT_EQ((*body)->measured(), own.measured());
  EXPECT_EQ((*body)->lines().size(), own.lines().size());
  for (const BodyLine& line : (*body)->lines())
    for (const Vec3& p : line.points) ASSERT_LT((*body)->bvh().nearest(p)->distance, 1e-9) << line.name;
}

TEST(Pose, LeftAndRightAreMirrorImages) {
  const auto bones = skeletonOf("eu50");
  BodyPose left, right;
  left[Joint::LeftShoulder] = right[Joint::RightShoulder] = {0.8, 0.5, 0.3};
  left[Joint::LeftHip] = right[Joint::RightHip] = {0.7, 0.2, 0.2};
  left[Joint::LeftElbow] = right[Joint::RightElbow] = {1.2, 0, 0.4};
  left[Joint::Spine] = {0.2, 0.2, 0.3}, right[Joint::Spine] = {0.2, -0.2, -0.3};
  const TriangleMesh a = meshIn(*bones, left), b = meshIn(*bones, right);
  const Bvh other(b);
  double worst = 0;
  for (const Vec3& p : a.points) worst = std::max(worst, other.nearest({-p.x, p.y, p.z})->distance);
  EXPECT_LT(worst, 0.003);
}

TEST(Pose, WhatNoJointCanDoIsRefusedByName) {
  const auto bones = skeletonOf("jis9ar");
  BodyPose pose;
  pose[Joint::LeftKnee] = {3, 0, 0};
  const auto body = posed(*bones, pose);
  ASSERT_FALSE(body);
  EXPECT_THAT(text(body.error().what),
              testing::AllOf(testing::HasSubstr("Left knee"), testing::HasSubstr("172°"), testing::HasSubstr("135°")));
  pose = {{Joint::LeftElbow, {std::nan(""), 0, 0}}};
  EXPECT_FALSE(posed(*bones, pose));
  pose = {{Joint::LeftShoulder, {2.5, 2.5, 0}}};
  EXPECT_FALSE(posed(*bones, pose));
  // Within the limits, but the arms would stand in the breast.
  pose = {{Joint::LeftShoulder, {0.4, -0.5, 0}}, {Joint::RightShoulder, {0.4, -0.5, 0}}};
  const auto crossed = posed(*bones, pose);
  ASSERT_FALSE(crossed);
  EXPECT_THAT(text(crossed.error().what), testing::HasSubstr("pass through itself"));
  EXPECT_FALSE(jointsNamed("tail"));
  EXPECT_EQ(jointsNamed("elbow").value().size(), 2u);
}

TEST(Pose, ABodyWithoutLimbsIsRefused) {
  Body::Parts parts;
  parts.mesh = test::ball({0, 0.8, 0}, 0.8, 3);
  const auto ball = Body::make(std::move(parts));
  ASSERT_TRUE(ball);
  const auto bones = Skeleton::of(*ball);
  ASSERT_FALSE(bones);
  EXPECT_THAT(text(bones.error().what), testing::HasSubstr("cannot be posed"));
}

}  // namespace
}  // namespace karinui
