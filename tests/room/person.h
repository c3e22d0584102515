#pragma once
// A person for tests: a head, and hands that point at places.
#include <cmath>

#include "fitting_room.h"

namespace karinui::room::test {

// A pose at `from` that looks along -z to `to`, upright.
inline Rigid aimed(Vec3 from, Vec3 to) {
  const Vec3 way = normalized(to - from);
  const double heading = std::atan2(-way.x, -way.z), rise = std::asin(way.y);
  Rigid pose = after(turnAbout({0, 1, 0}, heading), turnAbout({1, 0, 0}, rise));
  pose.carry = from;
  return pose;
}

struct Person {
  Rigid head{1, 0, 0, 0, {0, 1.55, 0}};
  FittingRoom::Hands hands;
  Vec3 shoulder{0.22, 1.15, -0.18};  // where the tool hand is held
  double seconds = 0;

  void pointAt(Vec3 place) {  // in the room
    ControllerState& hand = hands[FittingRoom::kRight];
    hand.tracked = true;
    hand.aim = hand.grip = aimed(shoulder, place);
  }
  // The tip itself there, the hand on its way from the shoulder.
  void touchAt(Vec3 place) {
    ControllerState& hand = hands[FittingRoom::kRight];
    hand.tracked = true;
    const Vec3 way = normalized(place - shoulder);
    hand.aim = hand.grip = aimed(place - way * kTipAhead, place);
  }
  void step(FittingRoom& room) { room.step(head, hands, seconds += 1 / 72.0); }
};

// The middle of a button, in the panel's own space.
inline Vec3 middleOf(const SceneMenu& panel, std::size_t button) {
  const SceneMenu::Button& b = panel.buttons[button];
  return panel.corner + normalized(panel.across) * (b.left + b.width / 2) +
         normalized(panel.upward) * (b.bottom + b.height / 2);
}

}  // namespace karinui::room::test
