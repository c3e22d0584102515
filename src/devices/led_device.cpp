#include "karinui/devices/led_device.h"

namespace karinui {

namespace {

constexpr HandModel kHand{0.2, 300, 8};  // overshoots by a sixth: stays below 1 m/s where it is led at 0.8

}  // namespace

LedDevice::LedDevice() : led_(simulatedRecord()), hand_({}, kHand) {}

HandSample LedDevice::sample() {
  HandSample sample = led_.sample();
  if (!sample.ready) {
    held_ = false;
    return sample;
  }
  if (!held_) hand_ = SimulatedHand(sample.tip.carry, kHand);
  held_ = true;
  hand_.step(sample.tip.carry, force_, kServoTick);
  sample.tip.carry = hand_.place();
  sample.velocity = hand_.velocity();
  return sample;
}

}  // namespace karinui
