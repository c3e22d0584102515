// While a figure is turned under the hand no skin shows through the garment.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

TEST(ClearOfSkin, WhatTheFigureHasGrownIntoStandsBeforeIt) {
  SessionOptions options;
  options.autoSettle = false;
  Session session(options);
  const auto lines = parseScript(
      "body size=jis9ar\ndraw name=front symmetric=yes edges=\"neck side hem\" line=\"torso:bust@0; torso:bust@0.2; "
      "torso:waist@0.2; torso:waist@0\"");
  ASSERT_TRUE(lines);
  for (const ScriptLine& line : *lines) session.perform(line.operation);
  session.finish();
  SetBody wider = *session.figure();
  wider.set = {{"bust_girth", {0.93}}};
  session.previewFigure(wider);
  session.finish();
  const Body& grown = *session.shown().body;
  std::size_t beside = 0;
  for (const SceneCloth& cloth : session.shown().frame.cloths) {
    for (const Vec3 p : cloth.mesh.points) {
      const double away = grown.field().distance(p);
      EXPECT_GT(away, 0);
      beside += away < 0.01;
    }
    for (const Triangle& f : cloth.mesh.faces) {
      const auto& at = cloth.mesh.points;
      EXPECT_GT(grown.field().distance((at[f[0]] + at[f[1]] + at[f[2]]) * (1.0 / 3)), 0);
    }
  }
  EXPECT_GT(beside, 0u);
}

}  // namespace
}  // namespace karinui
