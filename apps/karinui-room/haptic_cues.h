#pragma once
// What a hand feels through its controller's motor: contact, a snap, the tension of cloth that is pulled. The forces
// are those of touch (include/karinui/touch), turned into how strongly the motor runs. One thread.
#include <optional>
#include <vector>

#include "karinui/session/session.h"
#include "karinui/touch/evaluate.h"

namespace karinui::room {

struct HapticPulse {
  double amplitude = 0;  // 0 to 1
  double seconds = 0;
  bool operator==(const HapticPulse&) const = default;
};

class HapticCues {
 public:
  // What the session makes the hand feel (Session::touchSource()). `tip`: in the fitting, or none where the hand only
  // points or is out of sight. At most one pulse for each call.
  std::optional<HapticPulse> follow(const Session& session, std::optional<Vec3> tip, double seconds);
  void reset();

 private:
  TouchEvaluator evaluator_;
  std::optional<std::uint32_t> clicks_;  // so many the session had counted
  bool touching_ = false;
  double next_ = 0;  // when the motor may be told again
};

// How strongly a motor runs for a force: nothing below what is felt at all, all of it from `full` newtons on.
double amplitudeOf(double newtons, double full);

}  // namespace karinui::room
