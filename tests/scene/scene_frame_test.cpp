#include "karinui/scene/scene_frame.h"

#include <gtest/gtest.h>

namespace karinui {
namespace {

TEST(SceneFrame, ExtentLeavesOutWhatCannotBeDrawn) {
  SceneFrame frame;
  EXPECT_TRUE(extent(frame).empty());
  frame.lines.push_back({{{NAN, 0, 0}, {1, 2, 3}, {0, -1e9, 0}}});
  frame.bodies.push_back({{{{-1, 0, 0}, {0, INFINITY, 0}}, {}}});
  frame.cloths.emplace_back().mesh.points = {{0, 0, -4}};
  const Box box = extent(frame);
  EXPECT_EQ(box.low, (Vec3{-1, 0, -4}));
  EXPECT_EQ(box.high, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace karinui
