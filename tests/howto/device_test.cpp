// docs/develop/howto.md, A device: a knob on a rail, turned by nobody: it goes down by itself.
#include <gtest/gtest.h>

#include <atomic>

#include "karinui/touch/servo.h"
#include "touch/hand.h"

namespace karinui {
namespace {

class Knob : public HapticDevice {
 public:
  Knob() {
    record_.name = "knob";
    record_.freedomOut = 3;
    record_.force = 3.3;      // N
    record_.stiffness = 400;  // N/m
    record_.damping = 4;      // N s/m
  }
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override {
    // 5 mm above the floor for 0.2 s, then down to 3 mm below it at 2 cm/s; a tick is a millisecond.
    const double seconds = std::max(0, ticks_.load() - 200) * 1e-3;
    HandSample hand;
    hand.tip.carry = {0, std::max(-0.003, 0.005 - 0.02 * seconds), 0};
    hand.ready = true;
    return hand;
  }
  void apply(const HandForce& force) override {  // here a real one talks to its motors
    strongest = std::max(strongest.load(), force.force.y);
    now = force.force.y;
    ++ticks_;
    ticks_.notify_all();
  }
  void stop() override { now = 0, ++stops; }

  void waitFor(int ticks) const {
    for (int seen = ticks_; seen < ticks; seen = ticks_) ticks_.wait(seen);
  }
  std::atomic<double> strongest{0}, now{0};  // N, upwards
  std::atomic<int> stops{0};

 private:
  DeviceRecord record_;
  std::atomic<int> ticks_{0};
};

TEST(HowToAddADevice, TheServoMovesItWithinItsRecord) {
  Knob knob;
  ServoSettings settings;
  settings.rampSeconds = 0.1;
  settings.latest = settings.stalest = 1e9;  // a busy machine is not what is tested here
  settings.farthestJump = settings.fastest = 1e9;
  {
    Servo servo(knob, settings);
    servo.publish(std::make_unique<TouchScene>(floorScene()));
    knob.waitFor(1500);
    EXPECT_GT(knob.now, 0.3) << "the floor pushes back";
  }
  EXPECT_LE(knob.strongest, settings.nominalShare * knob.record().force);
  EXPECT_EQ(knob.now, 0) << "nothing is left in the hand";
  EXPECT_EQ(knob.stops, 1);
}

}  // namespace
}  // namespace karinui
