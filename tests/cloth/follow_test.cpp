#include "karinui/cloth/follow.h"

#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/body/pose.h"
#include "karinui/body/sizes.h"

namespace karinui::test {
namespace {

// A sheet in front of a figure's trunk, its threads drawn out so many times.
ClothLevel sheetBefore(const Body& body, double spacing, double drawnOut) {
  ClothLevel level = levelOf(patternOf({rectangle(1, 0.2, 0.2)}), spacing, *preset("cotton"));
  const double height = body.measured().value.at("waist_height");
  level.state = standingBy(level.cloth, [&](std::size_t, Flat at) {
    return Vec3{drawnOut * at.u, height + drawnOut * at.v, 0.2};
  });
  return level;
}

// Where a sheet goes while the figure makes a step.
std::vector<Vec3> gone(double drawnOut, bool wider) {
  Workers workers(2);
  const Token token;
  const auto body = makeMannequin(*builtInSize("eu38"), workers, token).value();
  const auto skeleton = Skeleton::of(body).value();
  ClothLevel level = sheetBefore(*body, 0.02, drawnOut);
  const Cloth wide = sheetBefore(*body, 0.04, drawnOut).cloth;
  EXPECT_TRUE(follow(level, wider ? &wide : nullptr, *skeleton, {}, namedPose("step")->pose, token, workers));
  return level.state.position;
}

TEST(Follow, GoesWhereWiderCellsHaveGone) { EXPECT_NE(gone(1, true), gone(1, false)); }

TEST(Follow, GoesByItselfWhereWiderCellsAreCaught) { EXPECT_EQ(gone(3, true), gone(3, false)); }

}  // namespace
}  // namespace karinui::test
