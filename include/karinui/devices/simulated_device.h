#pragma once
// A device without hardware: a simulated hand holds it. Its clock goes on by a tick with every sample, so it runs under
// the servo's thread and in tests alike.
#include <functional>

#include "karinui/touch/haptic_device.h"
#include "karinui/touch/simulated_hand.h"

namespace karinui {

DeviceRecord simulatedRecord();  // as of a small desktop device: 3.3 N, 400 N/m

class SimulatedDevice : public HapticDevice {
 public:
  // `aim`: where the hand means to be, by seconds; it must not allocate.
  explicit SimulatedDevice(std::function<Vec3(double)> aim, const DeviceRecord& record = simulatedRecord(),
                           const HandModel& model = {}, double tick = kServoTick)
      : record_(record), aim_(std::move(aim)), hand_(aim_(0), model), tick_(tick) {}
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override {
    hand_.step(aim_(now_), force_, tick_);
    now_ += tick_;
    HandSample sample;
    sample.tip.carry = hand_.place();
    sample.velocity = hand_.velocity();
    sample.buttons = buttons;
    sample.ready = true;
    return sample;
  }
  void apply(const HandForce& force) override { force_ = force.force; }
  void stop() override { force_ = {}; }
  const SimulatedHand& hand() const { return hand_; }
  std::uint32_t buttons = 0;

 private:
  DeviceRecord record_;
  std::function<Vec3(double)> aim_;
  SimulatedHand hand_;
  double tick_, now_ = 0;
  Vec3 force_;
};

}  // namespace karinui
