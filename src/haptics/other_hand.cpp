#include "karinui/haptics/other_hand.h"

namespace karinui {

namespace {

ServoSettings withoutForce() {
  ServoSettings settings;
  settings.gain = settings.limit = 0;
  return settings;
}

}  // namespace

OtherHand::OtherHand(std::unique_ptr<HapticDevice> device, bool realTime)
    : device_(std::move(device)), placed_(*device_, {}, ~0u), servo_(placed_, withoutForce(), realTime) {}

Vec3 OtherHand::takeLed() {
  const Vec3 led = servo_.last().hand.led, since = led - taken_;
  taken_ = led;
  return since;
}

}  // namespace karinui
