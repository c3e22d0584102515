#pragma once
// A simulated stylus that another thread leads, as a mouse does: a simulated hand is drawn to where it is led, and
// feels the force. To try force feedback, and what it does to a hand, without a device.
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"

namespace karinui {

class LedDevice : public HapticDevice {
 public:
  LedDevice();
  void lead(const Rigid& to, std::uint32_t buttons) { led_.place(to, buttons); }  // one thread
  void leave() { led_.leave(); }                                                  // the same: the hand lets go
  const DeviceRecord& record() const override { return led_.record(); }
  HandSample sample() override;
  void apply(const HandForce& force) override { force_ = force.force; }
  void stop() override { force_ = {}; }

 private:
  PoseSource led_;
  SimulatedHand hand_;
  bool held_ = false;
  Vec3 force_;
};

}  // namespace karinui
