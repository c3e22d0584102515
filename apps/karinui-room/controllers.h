#pragma once
// Two hand controllers by OpenXR's actions: poses, trigger, grip, buttons, stick, and the motor. Suggested for
// khr/simple_controller, oculus/touch_controller and valve/index_controller. One thread.
#include "controller_mapper.h"
#include "haptic_cues.h"
#include "headset.h"

namespace karinui::room {

class Controllers {
 public:
  static Result<std::unique_ptr<Controllers>> make(const Runtime& runtime, Headset& headset);
  ~Controllers();
  Controllers(const Controllers&) = delete;
  Controllers& operator=(const Controllers&) = delete;

  // As they will be when the picture is seen. Without the focus there are no hands.
  std::array<ControllerState, 2> read(XrTime time);
  void vibrate(std::size_t side, const HapticPulse& pulse);
  void still(std::size_t side);  // at once
  // "/interaction_profiles/valve/index_controller"; empty: none is held.
  std::string profile(std::size_t side) const;

 private:
  Controllers(const Runtime& runtime, Headset& headset) : runtime_(runtime), headset_(headset) {}
  Done makeActions();
  Done suggest();
  Done attach();

  const Runtime& runtime_;
  Headset& headset_;
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction aim_ = XR_NULL_HANDLE, palm_ = XR_NULL_HANDLE, trigger_ = XR_NULL_HANDLE, hold_ = XR_NULL_HANDLE,
           confirm_ = XR_NULL_HANDLE, cancel_ = XR_NULL_HANDLE, stick_ = XR_NULL_HANDLE, scale_ = XR_NULL_HANDLE,
           motor_ = XR_NULL_HANDLE;
  std::array<XrPath, 2> sides_{};
  std::array<XrSpace, 2> aimSpaces_{}, palmSpaces_{};
};

}  // namespace karinui::room
