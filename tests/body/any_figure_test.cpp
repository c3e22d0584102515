// What holds of every figure: of people with measurements drawn by lot, made as mannequins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/shapes.h"
#include "karinui/body/body.h"
#include "karinui/geometry/section.h"

namespace karinui {
namespace {

using test::Numbers;
using Part = BodyPoint::Part;

Measurements anyPerson(unsigned seed) {
  Numbers numbers(seed);
  Measurements wanted{seed % 2 ? Sex::Male : Sex::Female, {}};
  const bool female = wanted.sex == Sex::Female;
  const double height = wanted.value["height"] = numbers.between(1.5, 1.9), wide = numbers.between(0, 1);
  wanted.value["bust_girth"] = height * ((female ? 0.51 : 0.54) + 0.10 * wide);
  wanted.value["waist_girth"] = height * ((female ? 0.40 : 0.43) + 0.10 * wide);
  wanted.value["hip_girth"] = height * ((female ? 0.56 : 0.54) + 0.08 * wide);
  return wanted;
}

class AnyFigure : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    static std::map<unsigned, BodyPtr> made;  // once for all tests
    BodyPtr& body = made[GetParam()];
    if (!body) {
      Workers workers(1);
      auto result = makeMannequin(anyPerson(GetParam()), workers, Token{});
      ASSERT_TRUE(result) << "seed " << GetParam() << ": " << text(result.error().what);
      body = *result;
    }
    body_ = body;
  }
  Vec3 on(const SurfacePoint& place) const { return at(body_->mesh(), place); }
  double said(const char* key) const { return body_->measured().value.at(key); }

  BodyPtr body_;
};

INSTANTIATE_TEST_SUITE_P(Seed, AnyFigure, testing::Values(101u, 102u, 104u, 105u, 107u, 108u));

Vec3 across(Vec3 p) { return {-p.x, p.y, p.z}; }

TEST_P(AnyFigure, IsTheSameLeftAndRight) {
  for (const Vec3& p : body_->mesh().points) ASSERT_LT(body_->bvh().nearest(across(p))->distance, 0.002);
  std::size_t pairs = 0;
  for (const auto& [name, place] : body_->landmarks()) {
    if (!name.ends_with("_left")) continue;
    const Vec3 other = body_->landmarks().at(name.substr(0, name.size() - 4) + "right");
    EXPECT_LT(distance(across(place), other), 0.004) << name;
    ++pairs;
  }
  EXPECT_GE(pairs, 10u);
}

// Seen in the mirror, or standing elsewhere, a body has the same measurements. A mannequin is measured before it has
// its hands, and the narrowest place of the arm is found between rings of which one may lie on the hand: some 10
// micrometres.
TEST_P(AnyFigure, MeasuresTheSameWhereverItStands) {
  for (const bool mirrored : {false, true}) {
    TriangleMesh mesh = body_->mesh();
    for (Vec3& p : mesh.points) p = (mirrored ? across(p) : p) + Vec3{0.37, 0.21, -0.23};
    if (mirrored)
      for (Triangle& f : mesh.faces) std::swap(f[0], f[1]);
    const Measurements again = measure(mesh, Bvh(mesh));
    const bool belly = again.value.contains("belly_girth");  // of a figure that is only measured where it stands out
    ASSERT_EQ(again.value.size() + (belly ? 0 : 2), body_->measured().value.size());
    for (const auto& [key, value] : body_->measured().value) {
      if (!belly && key.starts_with("belly_")) continue;
      EXPECT_NEAR(again.value.at(key), value, mirrored ? (isAngle(key) ? 0.01 : 0.003) : 3e-5) << key << mirrored;
    }
  }
}

// The contours of level sections, tried every millimetre, are an oracle for the extreme girths.
TEST_P(AnyFigure, HipAndWaistAreTheExtremeGirthsOfTheirLevels) {
  const auto girths = [&](double y, double reach) {  // of what lies near the middle, in one tape
    std::vector<Vec3> points;
    for (const SectionLoop& contour : section(body_->mesh(), {{0, y, 0}, {0, 1, 0}})) {
      double middle = 0;
      for (const Vec3& p : contour.points) middle += p.x / static_cast<double>(contour.points.size());
      if (std::abs(middle) < reach) points.insert(points.end(), contour.points.begin(), contour.points.end());
    }
    return points.empty() ? 0 : tightTapeLength(points, {0, 1, 0});
  };
  double hip = 0, waist = 9;
  for (double y = said("crotch_height") + 0.01; y < said("crotch_height") + 0.2; y += 0.001)
    hip = std::max(hip, girths(y, 0.16));
  for (double y = said("hip_height") + 0.05; y < said("bust_height") - 0.07 * said("height"); y += 0.001)
    waist = std::min(waist, girths(y, 0.05));
  EXPECT_NEAR(said("hip_girth"), hip, 0.0015);
  EXPECT_NEAR(said("waist_girth"), waist, 0.0015);
  EXPECT_NEAR(girths(said("bust_height"), 0.05), said("bust_girth"), 0.002);
}

TEST_P(AnyFigure, ItsMeasurementsGoTogether) {
  const char* rising[] = {"ankle_height", "calf_height",       "knee_height", "crotch_height",   "hip_height",
                          "waist_height", "under_bust_height", "bust_height", "shoulder_height", "neck_height",
                          "height"};
  for (std::size_t i = 1; i < std::size(rising); ++i) EXPECT_LT(said(rising[i - 1]), said(rising[i])) << rising[i];
  EXPECT_LT(said("bust_height"), said("armpit_height"));
  EXPECT_LT(said("wrist_girth"), said("elbow_girth"));
  EXPECT_LT(said("ankle_girth"), said("calf_girth"));
  EXPECT_LT(said("calf_girth"), said("thigh_girth"));
  EXPECT_LE(said("waist_girth"), said("high_hip_girth") + 1e-3);
  EXPECT_LE(said("high_hip_girth"), said("hip_girth") + 1e-9);
  EXPECT_NEAR(said("upper_arm_length") + said("forearm_length"), said("arm_joint_length"), 1e-12);
  EXPECT_GT(said("arm_length"), said("arm_joint_length"));  // the shoulder point lies above the joint
}

TEST_P(AnyFigure, ATautTapeIsNoLongerThanTheSkinAndHoldsAllOfIt) {
  Numbers numbers(GetParam());
  int taped = 0;
  for (int n = 0; n < 200; ++n) {
    const Vec3 normal = normalized(numbers.point(1));
    const Vec3 through{numbers.between(-0.3, 0.3), numbers.between(0.1, 1.6), numbers.between(-0.1, 0.1)};
    for (const SectionLoop& contour : section(body_->mesh(), {through, normal})) {
      ASSERT_TRUE(contour.closed) << n;
      const auto tape = tightTape(contour.points, normal);
      if (tape.size() < 3) continue;
      const double length = tightTapeLength(contour.points, normal);
      EXPECT_LE(length, lineLength(contour.points, true) + 1e-9);
      EXPECT_GE(enclosedArea(tape, normal), std::abs(enclosedArea(contour.points, normal)) - 1e-12);
      Vec3 low = contour.points[0], high = low;
      const Vec3 along = normalized(cross(normal, numbers.point(1)));
      for (const Vec3& p : contour.points) {
        if (dot(p, along) < dot(low, along)) low = p;
        if (dot(p, along) > dot(high, along)) high = p;
      }
      EXPECT_GE(length, 2 * dot(high - low, along) - 1e-9);  // there and back
      // Every point of the skin lies left of every side of the tape.
      for (std::size_t i = 0; i < tape.size(); ++i) {
        const Vec3 a = tape[i], b = tape[(i + 1) % tape.size()];
        for (const Vec3& p : contour.points) ASSERT_GT(dot(cross(b - a, p - a), normal), -1e-12) << n;
      }
      ++taped;
    }
  }
  EXPECT_GT(taped, 100);
}

TEST_P(AnyFigure, APlaceOfTheChartIsFoundNamedAndFoundAgain) {
  Numbers numbers(GetParam() + 1);
  int found = 0, same = 0;
  for (const Part part : {Part::Torso, Part::LeftArm, Part::RightArm, Part::LeftLeg, Part::RightLeg})
    for (int n = 0; n < 80; ++n) {
      BodyPoint point;
      point.part = part;
      point.along = numbers.between(0, static_cast<double>(chartLevels(part).size() - 1));
      point.around = numbers.between(0, 1);
      const auto place = body_->find(point);
      if (!place) continue;  // there it runs into another part
      ++found;
      EXPECT_LT(body_->bvh().nearest(on(*place))->distance, 1e-9);
      const BodyPoint named = body_->describe(*place);
      const auto again = body_->find(named);
      ASSERT_TRUE(again) << text(point) << " is named " << text(named);
      EXPECT_LT(distance(on(*place), on(*again)), 1e-3) << text(point) << " is named " << text(named);
      const BodyPoint read = parseBodyPoint(text(point)).value();
      EXPECT_LT(distance(on(*body_->find(read)), on(*place)), 1e-9) << text(point);
      if (named.part == part) {
        same += std::abs(named.along - point.along) < 1e-6 &&
                std::abs(std::remainder(named.around - point.around, 1.0)) < 1e-6;
      }
      // Its mirror image is the place of the other side.
      const BodyPoint mirrored = body_->mirrored(point).value(), back = body_->mirrored(mirrored).value();
      EXPECT_EQ(back.part, point.part);
      EXPECT_NEAR(back.around, point.around, 1e-15);
      if (const auto other = body_->find(mirrored)) {
        EXPECT_LT(distance(across(on(*place)), on(*other)), 0.006) << text(point);
      }
    }
  EXPECT_GT(found, 300);
  EXPECT_GT(same, found * 8 / 10);
}

TEST_P(AnyFigure, ItsChartIsKeptInNumbers) {
  const std::vector<double> numbers = body_->chartNumbers();
  ASSERT_FALSE(numbers.empty());
  Body::Parts parts;
  parts.mesh = body_->mesh();
  parts.measured = body_->measured();
  parts.landmarks = body_->landmarks();
  parts.chart = Body::chartFrom(numbers);
  ASSERT_TRUE(parts.chart);
  const BodyPtr again = *Body::make(std::move(parts));
  EXPECT_EQ(again->chartNumbers(), numbers);
  EXPECT_EQ(again->hash(), body_->hash());
  std::vector<double> fewer = numbers, wrong = numbers;
  fewer.pop_back();
  wrong[7] = std::nan("");
  EXPECT_FALSE(Body::chartFrom(fewer));
  EXPECT_FALSE(Body::chartFrom(wrong));
}

}  // namespace
}  // namespace karinui
