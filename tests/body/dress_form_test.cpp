// A dress form is the trunk of a figure: the same measures, the same places.
#include <gtest/gtest.h>

#include "karinui/body/body.h"
#include "karinui/body/lines.h"
#include "karinui/body/sizes.h"

namespace karinui {
namespace {

using Part = BodyPoint::Part;

struct Pair {
  BodyPtr figure, form;
};

Pair madeFor(const Measurements& wanted) {  // once for all tests of this program
  static std::map<std::map<std::string, double>, Pair> known;
  if (const auto at = known.find(wanted.value); at != known.end()) return at->second;
  Workers workers(1);
  const Token token;
  const auto figure = makeMannequin(wanted, workers, token),
             form = makeMannequin(wanted, workers, token, MannequinEnds::DressForm);
  EXPECT_TRUE(figure && form);
  return known[wanted.value] = figure && form ? Pair{*figure, *form} : Pair{};
}

std::vector<Measurements> people() {
  return {*builtInSize("jis9ar"),
          *builtInSize("eu50"),
          {Sex::Female, {{"height", 1.45}, {"bust_girth", 0.80}, {"waist_girth", 0.62}, {"hip_girth", 0.86}}},
          {Sex::Female, {{"height", 1.65}, {"bust_girth", 1.02}, {"waist_girth", 0.99}, {"hip_girth", 1.06}}},
          {Sex::Male, {{"height", 1.75}, {"bust_girth", 1.18}, {"waist_girth", 1.14}, {"hip_girth", 1.18}}}};
}

TEST(DressForm, IsTheTrunkOfTheFigureOnAStand) {
  for (const Measurements& wanted : people()) {
    const auto [figure, form] = madeFor(wanted);
    ASSERT_TRUE(form);
    const MeshReport report = inspect(form->mesh());
    EXPECT_TRUE(report.closed() && report.outward);
    EXPECT_EQ(report.shells, 1u);
    EXPECT_EQ(report.selfCrossings, 0u);
    EXPECT_EQ(report.points + report.triangles - report.triangles * 3 / 2, 2u);  // genus 0
    EXPECT_EQ(form->measured(), figure->measured());
    const double height = figure->measured().value.at("height");
    Vec3 low{9, 9, 9}, high{-9, -9, -9};
    for (const Vec3& p : form->mesh().points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_NEAR(low.y, 0, 1e-9);
    EXPECT_LT(high.y, 0.92 * height) << "no head";
    EXPECT_LT(high.x, 0.16 * height) << "no arms";
    EXPECT_NEAR(low.x, -high.x, 0.003);
    // Only the pole stands between the thigh and the foot.
    const double half = 0.5 * figure->measured().value.at("knee_height");
    for (const auto& hit : form->bvh().all({-1, half, figure->landmarks().at("hip_left").z}, {1, 0, 0}))
      EXPECT_LT(std::abs(hit.along - 1), 0.03);
  }
}

TEST(DressForm, PlacesLandmarksAndLinesOfTheTrunkAreThoseOfTheFigure) {
  for (const Measurements& wanted : people()) {
    const auto [figure, form] = madeFor(wanted);
    ASSERT_TRUE(form);
    std::size_t found = 0;
    for (double along = 1.5; along < 8.5; along += 0.25)
      for (double around = 0; around < 1; around += 0.0625) {
        BodyPoint point;
        point.along = along, point.around = around;
        const auto here = figure->find(point), there = form->find(point);
        // Above the bust, sideways, an arm is on the figure and a cap on the form.
        if (!here || !there || (along > 5 && std::abs(std::remainder(around, 0.5)) > 0.18)) continue;
        EXPECT_LT(distance(at(figure->mesh(), *here), at(form->mesh(), *there)), 1e-9) << text(point);
        ++found;
      }
    EXPECT_GT(found, 300u);
    // A rim is evened, and where the hip is lowest groin and cleft are closed.
    for (const auto& [name, place] : form->landmarks()) {
      if (name == "hip_front" || name == "hip_back") {
        EXPECT_NEAR(place.y, figure->landmarks().at(name).y, 1e-9);
        EXPECT_NEAR(place.x, 0, 1e-6);
        EXPECT_EQ(place.z > form->landmarks().at("hip_left").z, name == "hip_front");
        continue;
      }
      const double most = name.starts_with("hip") ? 0.005 : name.starts_with("shoulder") ? 0.004 : 1e-9;
      EXPECT_LT(distance(place, figure->landmarks().at(name)), most) << name;
    }
    EXPECT_EQ(form->landmarks().size(), figure->landmarks().size() - 9)
        << "elbows, wrists, knees, ankles and the crotch";
    for (const char* name : {"centre_front", "centre_back", "shoulder_left", "neck_base", "armhole_right", "bust",
                             "waist", "hip", "princess_front_left"})
      EXPECT_TRUE(bodyLine(*form, name)) << name;
    for (const char* name : {"elbow_left", "wrist_left", "knee_right", "ankle_right"})
      EXPECT_FALSE(bodyLine(*form, name)) << name;
  }
}

TEST(DressForm, HasNoPlacesOnArmsAndLegs) {
  const auto [figure, form] = madeFor(*builtInSize("jis9ar"));
  ASSERT_TRUE(form);
  for (const char* place : {"left_arm:elbow@0", "right_arm:wrist@0.5", "left_leg:knee@0.25", "right_leg:ankle@0",
                            "torso:crown@0", "landmark:wrist_left", "line:knee_left@0.5"}) {
    EXPECT_TRUE(figure->find(*parseBodyPoint(place))) << place;
    const auto none = form->find(*parseBodyPoint(place));
    ASSERT_FALSE(none) << place;
    EXPECT_FALSE(text(none.error().what).empty());
  }
  const auto why = [form = form](const char* place) { return text(form->find(*parseBodyPoint(place)).error().what); };
  EXPECT_TRUE(why("left_arm:elbow@0").starts_with("This body has no arms")) << why("left_arm:elbow@0");
  EXPECT_TRUE(why("right_leg:knee@0.25").starts_with("This body has no legs")) << why("right_leg:knee@0.25");
}

}  // namespace
}  // namespace karinui
