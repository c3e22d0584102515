#pragma once
// Where menus hang: before the person, but fixed in the room. They follow only when the head has stayed turned away, or
// gone away, for a moment: what is fixed to the head cannot be looked at. One thread.
#include "placement.h"

namespace karinui::room {

class MenuAnchor {
 public:
  // `kept`: they stay where they are, for something on them or under way is pointed at.
  void follow(const Rigid& head, double seconds, bool kept);
  void place(const Rigid& head);  // at once
  Vec3 eyes() const { return eyes_; }
  double heading() const { return heading_; }

 private:
  Vec3 eyes_;
  double heading_ = 0;
  bool placed_ = false;
  std::optional<double> awaySince_;
};

}  // namespace karinui::room
