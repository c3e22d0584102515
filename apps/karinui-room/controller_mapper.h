#pragma once
// From a controller's pose and buttons to the session's pointer samples: a ray, or the fingertip where that touches
// something. Knows no OpenXR. One thread.
#include <functional>
#include <optional>

#include "karinui/scene/pointer.h"
#include "pattern_table.h"
#include "placement.h"

namespace karinui::room {

// One controller as a runtime tells of it, in the room.
struct ControllerState {
  bool tracked = false;  // its poses are known now
  Rigid aim, grip;       // where it points along its -z, and where the palm is
  double trigger = 0, hold = 0;
  bool confirm = false, cancel = false, scaleSwitch = false;
  Flat stick;
  bool operator==(const ControllerState&) const = default;
};

inline constexpr double kTipAhead = 0.03;              // metres from the aim pose to the tip that touches
inline constexpr double kTouching = 0.014;             // metres in the room
inline constexpr double kPointing = 0.011;             // radians of a ray
inline constexpr double kPressed = 0.6, kLetGo = 0.4;  // of the trigger and the grip

// A button out of a value that trembles: down above kPressed, up below kLetGo.
class AnalogButton {
 public:
  bool follow(double value) { return down_ = value > (down_ ? kLetGo : kPressed); }
  bool down() const { return down_; }
  void release() { down_ = false; }

 private:
  bool down_ = false;
};

class ControllerMapper {
 public:
  struct Around {
    const Placement& placement;
    const PatternTable& table;
    Vec3 head;  // in the room
    double seconds = 0;
    // How far along its ray this sample meets the fitting, metres of the fitting; none: it meets nothing. Asked with a
    // ray, and with a tip to learn whether that touches.
    std::function<std::optional<double>(const PointerSample&)> meets;
  };
  struct Mapped {
    std::optional<PointerSample> sample;  // for the session
    bool lost = false;                    // the trigger went up while the hand was out of sight: drop the drag
    Ray ray;                              // in the stand, from the tip, for drawing
    double along = 3;                     // metres of the stand to what it meets
    bool touching = false;
  };
  Mapped follow(const ControllerState& hand, PointerSample::Hand which, const Around& around);
  bool down() const { return down_; }
  // What was begun is over; a trigger that is still held begins nothing new.
  void drop() { down_ = false, trigger_.release(), dropped_ = true; }

 private:
  AnalogButton trigger_;
  bool down_ = false, unseen_ = false, dropped_ = false;
  bool touches_ = false, onTable_ = false;  // of the drag under way
  Flat lastPlace_;
  Vec3 meant_;  // what is pointed at, or was when the drag began; in the fitting
};

}  // namespace karinui::room
