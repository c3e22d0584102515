// A SpaceMouse in the real window: a daemon of the test's own speaks spacenavd's plain protocol.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>

#include "space_mouse.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

class Daemon {
 public:
  explicit Daemon(const fs::path& path) {
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listening_, 1), 0);
  }
  ~Daemon() { hangUp(); }
  void accept() { talking_ = ::accept(listening_, nullptr, nullptr); }
  void say(std::array<int, 8> words) { EXPECT_EQ(write(talking_, words.data(), sizeof words), 32); }
  void hangUp() {
    for (int* end : {&talking_, &listening_})
      if (*end >= 0) close(std::exchange(*end, -1));
  }

 private:
  int listening_ = -1, talking_ = -1;
};

TEST(StudioCap, TurnsPansAndZoomsAndGoesQuietlyWithItsDaemon) {
  KARINUI_NEEDS_DISPLAY();
#ifndef KARINUI_SPNAV
  GTEST_SKIP() << "built without libspnav";
#endif
  Folder folder;
  Daemon daemon(folder.path / "cap");
  setenv("SPNAV_SOCKET", (folder.path / "cap").c_str(), 1);
  Window w;
  unsetenv("SPNAV_SOCKET");
  daemon.accept();
  w.rest();
  const auto* cap = w.main().findChild<SpaceMouse*>();
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
  ASSERT_TRUE(w.main().findChild<SpaceMouse*>());
  EXPECT_FALSE(w.main().findChild<SpaceMouse*>()->there());
  EXPECT_TRUE(w.main().said().isEmpty());
}

}  // namespace
}  // namespace karinui::studio
