#include "karinui/view/camera.h"

#include <gtest/gtest.h>

#include <numbers>

#include "view/little_scenes.h"

namespace karinui {
namespace {

SceneFrame standing() {
  SceneFrame frame;
  frame.bodies.push_back(test::ball({0.1, 0.9, -0.2}, 0.9));
  frame.lines.push_back({{{-0.7, 0.4, 0.1}, {0.9, 1.1, 0.2}}});
  return frame;
}

TEST(Camera, EveryViewHoldsEverythingAndFillsThePicture) {
  const SceneFrame frame = standing();
  for (const double aspect : {0.5, 0.75, 1.0, 2.0})
    for (const View view : {View::Front, View::Back, View::Left, View::Right, View::Oblique}) {
      const Eye eye = eyeOf(frameAll(frame, view, aspect), aspect);
      double nearest = 1;  // smallest free share of half a side
      for (const auto* points : {&frame.bodies[0].mesh.points, &frame.lines[0].points})
        for (const Vec3 p : *points) {
          const OnPicture at = project(eye, p, 2, 2);
          nearest = std::min({nearest, at.x, 2 - at.x, at.y, 2 - at.y});
        }
      EXPECT_GT(nearest, 0.05) << nameOf(view) << aspect;
      EXPECT_LT(nearest, 0.16) << nameOf(view) << aspect;
    }
}

TEST(Camera, ViewsStandOnTheirSide) {
  const SceneFrame frame = standing();
  EXPECT_GT(frameAll(frame, View::Front, 1).eye.z, 2);
  EXPECT_LT(frameAll(frame, View::Back, 1).eye.z, -2);
  EXPECT_GT(frameAll(frame, View::Left, 1).eye.x, 2) << "the body's left hand is at +x";
  EXPECT_LT(frameAll(frame, View::Right, 1).eye.x, -2);
}

// What a standing person is, with one arm far out and a train: nothing about it is round.
SceneFrame lopsided(Vec3 at, double high) {
  SceneFrame frame;
  frame.bodies.push_back(test::ball(at + Vec3{0, high / 2, 0}, high / 2));
  frame.lines.push_back({{at + Vec3{0.9, 0.8 * high, 0.1}, at + Vec3{-0.2, 0.02, -1.1}}});
  return frame;
}

TEST(Camera, OneDistanceAndOneAimHoldScenesAtEveryTurn) {
  const std::vector<SceneFrame> frames{lopsided({3, 0, -2}, 1.7), lopsided({0, 0, 0}, 1.1)};
  for (const double aspect : {0.4, 0.6, 1.0, 2.0})
    for (const View view : {View::Front, View::Left, View::Oblique}) {
      const Camera camera = frameTurning(frames, view, aspect);
      double nearest = 1;  // smallest free share of half a side
      for (const SceneFrame& frame : frames)
        for (int k = 0; k < 72; ++k) {
          const Camera there = walkedRound(camera, axisOf(frame), k * std::numbers::pi / 36);
          EXPECT_NEAR(there.distance(), camera.distance(), 1e-9);
          EXPECT_NEAR(there.eye.y, camera.eye.y, 1e-12) << "the floor stays where it is";
          const Eye eye = eyeOf(there, aspect);
          for (const auto* points : {&frame.bodies[0].mesh.points, &frame.lines[0].points})
            for (const Vec3 p : *points) {
              const OnPicture at = project(eye, p, 2, 2);
              nearest = std::min({nearest, at.x, 2 - at.x, at.y, 2 - at.y});
            }
        }
      EXPECT_NEAR(nearest, 0.1, 0.005) << nameOf(view) << aspect << ": the widest turn meets the margin, none is cut";
    }
}

TEST(Camera, WalksTowardsTheLeftFirst) {
  const Camera front{{0, 1, 4}, {0, 1, 0}};
  const Camera left = walkedRound(front, {2, 0, 1}, std::numbers::pi / 2);
  EXPECT_NEAR(distance(left.target, {2, 1, 1}), 0, 1e-12);
  EXPECT_NEAR(distance(left.eye, {6, 1, 1}), 0, 1e-12) << "the body's left hand is at +x";
}

TEST(Camera, TheEyesSeeAPointAsFarApartAsTheFormulaSays) {
  Camera camera{{1, 1.3, 3}, {0, 1, 0}};
  const double aspect = 0.8, height = 1000, apart = 0.063;
  const Eye left = eyeOf(camera, aspect, -apart / 2), right = eyeOf(camera, aspect, apart / 2);
  for (const Vec3 p : {Vec3{0, 1, 0}, Vec3{0.2, 0.5, 0.9}, Vec3{-0.4, 1.6, -1.5}}) {
    const OnPicture l = project(left, p, aspect * height, height), r = project(right, p, aspect * height, height);
    EXPECT_NEAR(l.x - r.x, disparity(camera, height, apart, l.depth), 1e-9);
    EXPECT_NEAR(l.y, r.y, 1e-9) << "no vertical disparity";
  }
  EXPECT_NEAR(disparity(camera, height, apart, camera.distance()), 0, 1e-12);
}

TEST(Camera, LooksStraightDownWithoutLosingItsBearings) {
  const Eye eye = eyeOf({{0, 3, 0}, {0, 0, 0}}, 1);
  const OnPicture middle = project(eye, {0, 0, 0}, 100, 100);
  EXPECT_NEAR(middle.x, 50, 1e-9);
  EXPECT_NEAR(middle.y, 50, 1e-9);
}

TEST(Camera, FramesNothingAndNoNumbersAsIfAPersonStoodThere) {
  SceneFrame broken;
  broken.lines.push_back({{{NAN, 0, 0}, {1e300, INFINITY, 0}}});
  for (const SceneFrame& frame : {SceneFrame{}, broken}) {
    const Camera camera = frameAll(frame, View::Front, 0.75);
    EXPECT_TRUE(finite(camera.eye));
    EXPECT_NEAR(camera.target.y, 0.85, 0.1);
  }
}

TEST(Camera, APictureIsFramedForWhatIsWorn) {
  SceneFrame frame = standing();
  frame.cloths.push_back(test::sheet(-0.3, 0.5, 0.3, 1.2, 0.8));
  const Camera alone = frameAll(frame, View::Front, 1);
  frame.cloths.push_back(test::sheet(3, 0.5, 3.6, 1.2, 0));
  frame.lines.push_back({{{3, 0.5, 0}, {3.6, 0.5, 0}}});
  std::size_t apart = 0;
  const Camera camera = frameAll(worn(frame, &apart), View::Front, 1);
  EXPECT_EQ(apart, 1u);
  EXPECT_EQ(camera.eye, alone.eye);
  EXPECT_EQ(camera.target, alone.target);
  EXPECT_GT(frameAll(frame, View::Front, 1).distance(), 1.3 * alone.distance());
  // Where nothing is worn yet the pieces are what there is to see; and without a figure nothing is apart from it.
  SceneFrame unworn = standing(), noBody = frame;
  unworn.cloths.push_back(frame.cloths[1]);
  noBody.bodies.clear();
  for (const SceneFrame* all : {&unworn, &noBody}) {
    const SceneFrame kept = worn(*all, &apart);
    EXPECT_EQ(apart, 0u);
    EXPECT_EQ(kept.cloths.size(), all->cloths.size());
  }
}

TEST(Camera, NamesAreReadBackAndStrangeOnesRefused) {
  for (const View view : {View::Front, View::Back, View::Left, View::Right, View::Oblique})
    EXPECT_EQ(*viewNamed(nameOf(view)), view);
  for (const Eyes eyes : {Eyes::Mono, Eyes::SideBySide, Eyes::TopBottom, Eyes::Anaglyph})
    EXPECT_EQ(*eyesNamed(nameOf(eyes)), eyes);
  EXPECT_NE(text(viewNamed("above").error().what).find("oblique"), std::string::npos);
  EXPECT_NE(text(eyesNamed("three").error().what).find("anaglyph"), std::string::npos);
}

}  // namespace
}  // namespace karinui
