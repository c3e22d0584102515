// The floating menu: where it hangs, and that a tip works it as a ray does.
#include "karinui/session/menu.h"

#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

TEST(Menu, HangsInViewAndKnowsItsButtons) {
  Viewpoint sight;
  sight.eye = {1, 2, 3};
  sight.aspect = 0.8;
  const SceneMenu panel = menuPanel(sight, {});
  EXPECT_EQ(panel.buttons.size(), menuBar().size());
  EXPECT_FALSE(menuHit(panel, {sight.eye, -sight.back}));  // the middle of the view is free
  EXPECT_FALSE(meets(panel, {sight.eye, sight.back}));     // nothing behind
  for (const auto& b : panel.buttons) {
    EXPECT_GE(b.left, 0);
    EXPECT_LE(b.left + b.width, length(panel.across));
    EXPECT_LE(b.bottom + b.height, length(panel.upward));
  }
}

TEST(Menu, ATipTouchesItsBoard) {
  Session session;
  const auto lines = parseScript(kTwoPieces);
  for (const ScriptLine& line : *lines) session.perform(line.operation);
  session.finish();
  Viewpoint sight;
  sight.eye = {0, 1, 2};
  session.setViewpoint(sight);
  const SceneMenu panel = *session.menu();
  const SceneMenu::Button& move = panel.buttons.at(1);
  const Vec3 across = normalized(panel.across), upward = normalized(panel.upward), normal = cross(across, upward);
  const Vec3 middle = panel.corner + across * (move.left + move.width / 2) + upward * (move.bottom + move.height / 2);
  PointerSample sample;
  sample.reach = 0.01;
  sample.ray = {{0, 50, 0}, {0, 1, 0}};  // past everything
  sample.tip.emplace().carry = middle + normal * 0.02;
  session.feed(sample);
  EXPECT_FALSE(session.menu()->buttons.at(1).hot);
  sample.tip->carry = middle + normal * 0.005;
  session.feed(sample);
  EXPECT_TRUE(session.menu()->buttons.at(1).hot);
  sample.phase = PointerSample::Phase::Press;
  session.feed(sample);
  EXPECT_EQ(session.tool(), Command::Move);
}

}  // namespace
}  // namespace karinui
