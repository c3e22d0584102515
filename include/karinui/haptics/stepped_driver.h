#pragma once
// What HapticDriver does, by a virtual clock and in one thread: for recorded hands, and for tests. The session is
// waited for, so that the same device feels the same.
#include <memory>
#include <optional>
#include <vector>

#include "karinui/haptics/stylus_pointer.h"
#include "karinui/session/session.h"

namespace karinui {

class SteppedDriver {
 public:
  static constexpr double kTick = 0.001;  // seconds

  // Session and device must outlive it.
  SteppedDriver(Session& session, HapticDevice& device, const ServoSettings& settings = {});

  // One tick of the force loop: where the hand is, what it feels, and that to the device.
  ServoTick tick();
  // What the hand did since the last time to the session, and what the session shows then to the loop. Before the first
  // time nothing is felt. `facing`: unit, towards who looks.
  void publish(Vec3 facing = {0, 0, 1});
  double now() const { return now_; }  // seconds since it began
  const TouchScene* scene() const { return kept_.empty() ? nullptr : kept_.back().get(); }

 private:
  Session& session_;
  HapticDevice& device_;
  ServoStep step_;
  StylusPointer pointer_;
  Vec3 tip_;
  std::optional<Vec3> proxy_;  // where it is stopped
  double now_ = 0;
  std::vector<std::unique_ptr<TouchScene>> kept_;  // the loop blends from one to the next
  const TouchScene* waiting_ = nullptr;            // until it has
  std::vector<ServoTick> ticks_;                   // since the last publish()
};

}  // namespace karinui
