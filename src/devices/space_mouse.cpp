#include "karinui/devices/space_mouse.h"

#include <algorithm>
#include <atomic>
#include <cerrno>

#ifdef KARINUI_SPNAV
#include <sys/socket.h>
#define SPNAV_CONFIG_H_  // libspnav's X11 half, and the names it brings, are not for us
#include <spnav.h>
#endif

namespace karinui {

namespace {
std::atomic<bool> connected{false};
}  // namespace

bool SpaceMouse::taken() { return connected; }

SpaceMouse::SpaceMouse() {
  record_.name = "SpaceMouse";
  record_.freedomIn = 6;
  hand_.ready = true;
}

#ifdef KARINUI_SPNAV

namespace {
constexpr double kFull = 350;      // what a cap pushed to its end says
constexpr double kLongest = 0.05;  // seconds: after a pause the first motion counts no more
constexpr double kReach = 0.1;     // m/s
constexpr double kTurn = 1;        // rad/s
}  // namespace

Result<std::unique_ptr<SpaceMouse>> SpaceMouse::open() {
  if (connected) return notFound(say("The SpaceMouse is in use already."));
  if (spnav_open() == -1) return notFound(say("No SpaceMouse: spacenavd does not run. Start it and try again."));
  connected = true;
  return std::unique_ptr<SpaceMouse>(new SpaceMouse);
}

SpaceMouse::~SpaceMouse() {
  spnav_close();
  connected = false;
}

int SpaceMouse::descriptor() const { return spnav_fd(); }

std::optional<SpaceMouse::Event> SpaceMouse::next() {
  char byte = 0;
  const auto waiting = there_ ? recv(spnav_fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) : 0;
  if (waiting == 0 || (waiting < 0 && errno != EAGAIN && errno != EINTR)) there_ = false;  // the daemon is gone
  spnav_event came;
  while (there_ && spnav_poll_event(&came) != 0) {
    if (came.type == SPNAV_EVENT_BUTTON) return Event{{}, came.button.bnum, came.button.press != 0};
    if (came.type != SPNAV_EVENT_MOTION) continue;
    const auto& m = came.motion;
    return Event{CapMotion{m.x / kFull, m.y / kFull, m.z / kFull, m.rx / kFull, m.ry / kFull,
                           std::clamp(static_cast<double>(m.period) / 1000, 0.001, kLongest)}};
  }
  return std::nullopt;
}

HandSample SpaceMouse::sample() {
  while (const auto event = next()) {
    if (event->button >= 0 && event->button < 32) {
      const std::uint32_t bit = 1u << event->button;
      hand_.buttons = event->pressed ? hand_.buttons | bit : hand_.buttons & ~bit;
    }
    if (!event->motion) continue;
    const CapMotion& m = *event->motion;
    hand_.velocity = Vec3{m.right, m.up, -m.away} * kReach;
    const Vec3 carry = hand_.tip.carry + hand_.velocity * m.seconds;
    hand_.tip = after(
        after(turnAbout({0, 1, 0}, -kTurn * m.turn * m.seconds), turnAbout({1, 0, 0}, kTurn * m.tilt * m.seconds)),
        hand_.tip);
    hand_.tip.carry = carry;
    if (m.right == 0 && m.up == 0 && m.away == 0) hand_.velocity = {};
  }
  hand_.ready = there_;
  return hand_;
}

#else

Result<std::unique_ptr<SpaceMouse>> SpaceMouse::open() {
  return notFound(say("No SpaceMouse: this program was built without libspnav."));
}
SpaceMouse::~SpaceMouse() = default;
int SpaceMouse::descriptor() const { return -1; }
std::optional<SpaceMouse::Event> SpaceMouse::next() { return std::nullopt; }
HandSample SpaceMouse::sample() { return hand_; }

#endif

}  // namespace karinui
