#pragma once
// The device of the other hand: while one of its buttons is down it leads, and the face turns the body by it. It works
// beside the main one and never has a force: its loop is shown no scene, and has neither gain nor limit. (It needs a
// loop all the same: an Inverse3 says where it is only in answer to a force.) One thread, behind it that of the loop.
#include <memory>

#include "karinui/devices/placement.h"
#include "karinui/touch/servo.h"

namespace karinui {

class OtherHand {
 public:
  explicit OtherHand(std::unique_ptr<HapticDevice> device, bool realTime = true);

  // How far it was led since the last time, metres of the device: right, up, towards the user.
  Vec3 takeLed();
  const DeviceRecord& record() const { return placed_.record(); }
  ServoTick last() const { return servo_.last(); }

 private:
  std::unique_ptr<HapticDevice> device_;
  PlacedDevice placed_;  // all buttons are clutches: it tells how far it is led
  Vec3 taken_;
  Servo servo_;  // last: it uses the others
};

}  // namespace karinui
