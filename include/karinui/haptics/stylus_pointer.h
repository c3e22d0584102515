#pragma once
// From the ticks of a force loop to the samples of a pointer that a session is fed. While it touches, the pointer is
// where the proxy is: on the surface, as it is seen, not as deep in it as the device's spring lets the hand. Pure; one
// thread.
#include <optional>
#include <vector>

#include "karinui/scene/pointer.h"
#include "karinui/touch/servo_step.h"

namespace karinui {

struct StylusSettings {
  std::uint32_t mainButtons = 1;    // bits: the phase of the samples
  std::uint32_t secondButtons = 0;  // bits
  PointerSample::Hand hand = PointerSample::Hand::Either;
  double reach = 0.01;  // metres
};

class StylusPointer {
 public:
  explicit StylusPointer(const StylusSettings& settings = {}) : settings_(settings) {}

  // What is to be fed of a tick, `facing` being the unit direction towards who looks; nothing where the hand has not
  // moved. Of a drag all places 2 mm apart are fed, others wait for rest().
  std::optional<PointerSample> of(const ServoTick& tick, Vec3 facing);
  // The newest place that was not fed yet: called when no more ticks are there.
  std::optional<PointerSample> rest();
  bool down() const { return down_; }
  // The device stopped answering while its button was down: what was begun is to be dropped. Once. When it is back,
  // a button that is still down presses nothing until it was let go.
  bool takeLost() { return std::exchange(lost_, false); }

 private:
  StylusSettings settings_;
  std::optional<PointerSample> fed_, waiting_;
  bool down_ = false, lost_ = false;
  bool stuck_ = false;  // since the device was lost the button has not been seen up
};

}  // namespace karinui
