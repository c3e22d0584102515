#pragma once
// A daemon of the tests' own that speaks spacenavd's plain protocol (version 0: eight ints an event).
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace karinui {

class CapDaemon {
 public:
  explicit CapDaemon(const std::filesystem::path& path) {
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listening_, 1), 0);
  }
  ~CapDaemon() { hangUp(); }
  void accept() { talking_ = ::accept(listening_, nullptr, nullptr); }
  void say(std::array<int, 8> words) { EXPECT_EQ(write(talking_, words.data(), sizeof words), 32); }
  void push(int right, int up, int away, int tilt, int turn, int milliseconds) {
    say({0, right, up, away, tilt, turn, 0, milliseconds});
  }
  void button(int which, bool down) { say({down ? 1 : 2, which, 0, 0, 0, 0, 0, 0}); }
  void hangUp() {
    for (int* end : {&talking_, &listening_})
      if (*end >= 0) close(std::exchange(*end, -1));
  }

 private:
  int listening_ = -1, talking_ = -1;
};

}  // namespace karinui
