#pragma once
// What a hand feels through its controller's motor: contact, a snap, the tension of cloth that is pulled. The forces
// are those of touch (include/karinui/touch), turned into how strongly the motor runs. One thread.
#include <optional>
#include <vector>

#include "karinui/session/session.h"
#include "karinui/session/touch_scene_of.h"
#include "karinui/touch/evaluate.h"

namespace karinui::room {

struct HapticPulse {
  double amplitude = 0;  // 0 to 1
  double seconds = 0;
  bool operator==(const HapticPulse&) const = default;
};

class HapticCues {
 public:
  // The tip in the fitting, or none where the hand only points or is out of sight. `sample`: what the session was fed.
  // At most one pulse for each call.
  std::optional<HapticPulse> follow(const Session& session, const PointerSample& sample, std::optional<Vec3> tip,
                                    double seconds);
  void reset();

 private:
  bool snapped(const Session& session) const;
  TouchEvaluator evaluator_;
  std::optional<Handling::Pull> pull_;
  bool touching_ = false, snapped_ = false;
  double next_ = 0;  // when the motor may be told again
};

// How strongly a motor runs for a force: nothing below what is felt at all, all of it from `full` newtons on.
double amplitudeOf(double newtons, double full);

}  // namespace karinui::room
