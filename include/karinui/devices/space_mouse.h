#pragma once
// A cap that moves in all six ways (SpaceMouse), through spacenavd and its library libspnav; a device without a motor,
// that comes back to rest when it is let go. Tested before a daemon of ours, which speaks spacenavd's protocol; not on
// hardware. One in a program: the connection is libspnav's own. One thread.
#include <memory>

#include "karinui/base/result.h"
#include "karinui/touch/haptic_device.h"

namespace karinui {

// How far the cap is from its rest, 1: as far as it goes; over how many seconds.
struct CapMotion {
  double right = 0, up = 0, away = 0;  // pushed
  double tilt = 0, turn = 0;           // its top towards the person; its front to the right
  double seconds = 0;
};

class SpaceMouse : public HapticDevice {
 public:
  // NotFound, with a sentence, where no daemon runs or this program is connected already.
  static Result<std::unique_ptr<SpaceMouse>> open();
  static bool taken();  // this program is connected
  ~SpaceMouse() override;

  // For who follows its pushes: what came next, without waiting for it. Nothing: there is no more.
  struct Event {
    std::optional<CapMotion> motion;
    int button = -1;  // from 0; -1: none
    bool pressed = false;
  };
  std::optional<Event> next();
  int descriptor() const;                // readable when something came
  bool there() const { return there_; }  // the daemon still runs

  // As a device: its tip goes on while the cap is pushed, a tenth of a metre and one radian a second at most, in the
  // axes of all devices.
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override;
  void apply(const HandForce&) override {}
  void stop() override {}

 private:
  SpaceMouse();
  DeviceRecord record_;
  HandSample hand_;
  bool there_ = true;
};

}  // namespace karinui
