// A SpaceMouse in the real window: a daemon of the test's own speaks spacenavd's plain protocol.
#include <gmock/gmock.h>

#include "cap.h"
#include "devices/cap_daemon.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

TEST(StudioCap, TurnsPansAndZoomsAndGoesQuietlyWithItsDaemon) {
  KARINUI_NEEDS_DISPLAY();
#ifndef KARINUI_SPNAV
  GTEST_SKIP() << "built without libspnav";
#endif
  Folder folder;
  CapDaemon daemon(folder.path / "cap");
  setenv("SPNAV_SOCKET", (folder.path / "cap").c_str(), 1);
  Window w;
  unsetenv("SPNAV_SOCKET");
  daemon.accept();
  w.rest();
  const auto* cap = w.main().findChild<Cap*>();
  ASSERT_TRUE(cap && cap->there());
  const auto pushed = [&](std::array<int, 8> words) {
    const Camera before = w.space().camera();
    daemon.say(words);
    QApplication::processEvents();
    w.rest();
    return std::pair(before, w.space().camera());
  };
  const auto arm = [](const Camera& c) { return c.eye - c.target; };
  {
    const auto [before, after] = pushed({0, 0, 0, 0, 0, 350, 0, 50});  // turned
    EXPECT_NEAR(distance(before.target, after.target), 0, 1e-9);
    EXPECT_NEAR(length(arm(before)), length(arm(after)), 1e-9);
    EXPECT_GT(dot(cross(arm(after), arm(before)), Vec3{0, 1, 0}), 0) << "its front goes to the right";
  }
  {
    const auto [before, after] = pushed({0, 0, 0, 350, 0, 0, 0, 50});  // pushed away
    EXPECT_GT(after.distance(), before.distance());
  }
  {
    const auto [before, after] = pushed({0, 350, 0, 0, 0, 0, 0, 50});  // pushed to the right
    EXPECT_LT(dot(after.eye - before.eye, before.right()), -0.001);
    EXPECT_NEAR(after.distance(), before.distance(), 1e-9);
  }
  daemon.hangUp();
  QApplication::processEvents();
  w.rest();
  EXPECT_FALSE(cap->there()) << "gone with its daemon, and nothing is said";
  EXPECT_TRUE(w.main().said().isEmpty());
}

TEST(StudioCap, WithoutADaemonThereSilentlyIsNone) {
  KARINUI_NEEDS_DISPLAY();
  Folder folder;
  setenv("SPNAV_SOCKET", (folder.path / "nobody").c_str(), 1);
  Window w;
  unsetenv("SPNAV_SOCKET");
  w.rest();
  ASSERT_TRUE(w.main().findChild<Cap*>());
  EXPECT_FALSE(w.main().findChild<Cap*>()->there());
  EXPECT_TRUE(w.main().said().isEmpty());
}

}  // namespace
}  // namespace karinui::studio
