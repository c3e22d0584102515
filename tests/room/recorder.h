#pragma once
// A person whose every picture is worked in this process and written down as recorded poses, for the program to play.
#include "person.h"
#include "pose_script.h"

namespace karinui::room::test {

class Recorder {
 public:
  explicit Recorder(FittingRoom& room) : room_(room) {
    person.head = asFloats(person.head);
    hands_ = headLine(0, person.head);
    marks_ = "0 wait on\n";
  }

  // So many pictures as the hands are now; each waits for what is worked out.
  void hold(int pictures = 1) {
    for (int k = 0; k < pictures; ++k) {
      for (std::size_t side = 0; side < 2; ++side) {
        ControllerState& hand = person.hands[side];
        hand.aim = asFloats(hand.aim);
        hand.grip = hand.aim;
        if (!(hand == before_[side])) hands_ += handLine(picture_, side, hand), before_[side] = hand;
      }
      person.seconds = static_cast<double>(picture_++) * 13'888'889e-9;
      room_.session().finish();
      room_.step(person.head, person.hands, person.seconds);
      room_.session().finish();
      room_.session().update();
    }
  }
  void trigger(double value) { tool().trigger = value, hold(3); }
  void click() { hold(2), trigger(1), trigger(0); }
  void clickAt(Vec3 fitting) { pointAt(fitting), click(); }
  void pointAt(Vec3 fitting) { person.pointAt(room_.placement().fittingToRoom(fitting)); }
  void touchAt(Vec3 fitting) { person.touchAt(room_.placement().fittingToRoom(fitting)); }
  // Along a straight way, by the ray or by the tip.
  void drag(Vec3 from, Vec3 to, bool touching, int pictures = 30) {
    const auto at = [&](Vec3 p) { touching ? touchAt(p) : pointAt(p); };
    at(from), hold(3), trigger(1);
    for (int k = 1; k <= pictures; ++k) at(lerp(from, to, static_cast<double>(k) / pictures)), hold();
    hold(3), trigger(0);
  }
  void choose(Command command) {
    const auto menu = room_.menu();
    std::size_t button = 0;
    while (menuBar()[button] != command) ++button;
    clickAt(middleOf(*menu, button));
  }
  void press(bool ControllerState::*button) {
    tool().*button = true, hold(2);
    tool().*button = false, hold(2);
  }
  void picture(const std::string& name) {
    marks_ += std::to_string(picture_) + " picture " + name + "\n";
    pictures_.push_back(name);
    hold(2);
  }
  void event(const std::string& what) { hands_ += std::to_string(picture_) + " " + what + "\n"; }
  ControllerState& tool() { return person.hands[FittingRoom::kRight]; }
  ControllerState& other() { return person.hands[FittingRoom::kLeft]; }

  std::string hands() const { return hands_; }
  std::string marks() const { return marks_ + std::to_string(picture_ + 2) + " end\n"; }
  long picture() const { return picture_; }
  const std::vector<std::string>& pictures() const { return pictures_; }

  Person person;

 private:
  FittingRoom& room_;
  std::string hands_, marks_;
  std::vector<std::string> pictures_;
  FittingRoom::Hands before_;
  long picture_ = 0;
};

}  // namespace karinui::room::test
