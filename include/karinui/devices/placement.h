#pragma once
// Where a device's workspace lies in the scene: calibration, scale and clutch. A device behind it looks like one whose
// tip moves in the scene.
#include <atomic>

#include "karinui/touch/haptic_device.h"
#include "karinui/touch/seq_lock.h"

namespace karinui {

// scene = turn(device - deviceCentre) * scale + sceneCentre
struct Placement {
  Rigid turn;  // its carry is not used
  Vec3 deviceCentre, sceneCentre;
  double scale = 1;
  Vec3 toScene(Vec3 device) const { return turn.turned(device - deviceCentre) * scale + sceneCentre; }
  // The same, carried so that a place of the device comes to a place of the scene: calibration by pointing.
  Placement broughtTo(Vec3 device, Vec3 scene) const;
};

// Forces come back turned; the stiffness and damping that are stable for the device are so in the scene divided by the
// scale. While a clutch button is down the tip stays where it is in the scene, and goes on from there when it is let
// go.
class PlacedDevice : public HapticDevice {
 public:
  // The inner device must outlive it.
  PlacedDevice(HapticDevice& inner, const Placement& placement, std::uint32_t clutchButtons = 0,
               DeviceRecord::Hand hand = DeviceRecord::Hand::Either);
  // Any one thread; the newest wish of each kind counts.
  void place(const Placement& placement);               // the scale stays as it was
  void bringTo(Vec3 scene) { bring_.wish(scene); }      // the tip, wherever it is: calibration by pointing
  void turnTo(const Rigid& turn) { turn_.wish(turn); }  // the workspace about the tip, which stays: no jump
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override;
  void apply(const HandForce& force) override;
  void stop() override { inner_.stop(); }

 private:
  template <class T>
  class Wish {  // of one thread to the servo's
   public:
    void wish(const T& value) {
      value_.write(value);
      count_.fetch_add(1, std::memory_order_release);
    }
    bool take(T& value) {
      const std::uint32_t count = count_.load(std::memory_order_acquire);
      if (count == taken_ || !value_.tryRead(value)) return false;
      taken_ = count;
      return true;
    }

   private:
    SeqLock<T> value_;
    std::atomic<std::uint32_t> count_{0};
    std::uint32_t taken_ = 0;  // the servo's only
  };
  HapticDevice& inner_;
  DeviceRecord record_;
  std::uint32_t clutchButtons_;
  Wish<Placement> place_;
  Wish<Vec3> bring_;
  Wish<Rigid> turn_;
  Placement placement_;
  bool clutched_ = false;
  Rigid held_;  // the tip in the scene meanwhile
  Vec3 led_, before_;
};

}  // namespace karinui
