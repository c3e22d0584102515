#pragma once
// Devices without a motor: what a mouse, a SpaceMouse or a controller points at becomes a tip; the force is computed
// all the same, to be shown. And a recorded hand.
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/scene/pointer.h"
#include "karinui/touch/haptic_device.h"
#include "karinui/touch/seq_lock.h"

namespace karinui {

// What is computed for a device without a motor: as a small desktop device would give.
DeviceRecord shownRecord(std::string name);

// A pose that one thread sets and the servo follows. Events come some hundred times a second at best, so the tip glides
// to each at up to 0.8 m/s; a hand that moves so far at once is not taken for a fault.
class PoseSource : public HapticDevice {
 public:
  explicit PoseSource(DeviceRecord record);
  void place(const Rigid& tip, std::uint32_t buttons, double trigger = 0);  // one thread
  void leave();                                                             // the same: nothing is pointed at
  HandForce force() const { return force_.read(); }                         // any thread
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override;
  void apply(const HandForce& force) override { force_.write(force); }
  void stop() override { force_.write({}); }

 private:
  DeviceRecord record_;
  SeqLock<HandSample> wanted_;
  SeqLock<HandForce> force_;
  HandSample aim_, now_;
  bool placed_ = false;
};

// A recorded hand (lines of scene/pointer.h that have a tip; all others are left out), a day long at most, played tick
// by tick and straight from sample to sample. At its end it is not ready any more.
inline constexpr double kLongestHand = 24 * 3600;  // seconds
class ScriptedDevice : public HapticDevice {
 public:
  // `rest`: seconds that it is at its first place before it begins, its buttons up.
  static Result<ScriptedDevice> read(std::string_view text, const DeviceRecord& record, double tick = kServoTick,
                                     double rest = 0);
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override;
  void apply(const HandForce& force) override { force_ = force; }
  void stop() override { force_ = {}; }
  double begins() const { return samples_.front().seconds; }
  double ends() const { return samples_.back().seconds; }
  const HandForce& force() const { return force_; }

 private:
  DeviceRecord record_;
  std::vector<PointerSample> samples_;
  double tick_ = kServoTick, now_ = 0;
  std::size_t at_ = 0;
  HandForce force_;
};

}  // namespace karinui
