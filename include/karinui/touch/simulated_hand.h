#pragma once
// A hand without a person: a mass that is drawn to where it means to go by a spring and a damper, and that feels a
// force. For tests, and to measure the force loop without a device. Its clock is what it is told; one thread.
#include "karinui/geometry/vec.h"

namespace karinui {

struct HandModel {
  double mass = 0.2;       // kg, hand and handle
  double stiffness = 300;  // N/m, of the grip
  double damping = 5;      // N s/m
};

class SimulatedHand {
 public:
  explicit SimulatedHand(Vec3 start, const HandModel& model = {}) : model_(model), place_(start) {}
  // Means to be at `aim`, feels `force` all the while.
  void step(Vec3 aim, Vec3 force, double seconds) {
    constexpr int kParts = 10;
    const double dt = seconds / kParts;
    for (int k = 0; k < kParts; ++k) {
      const Vec3 push = (aim - place_) * model_.stiffness - velocity_ * model_.damping + force;
      velocity_ += push * (dt / model_.mass);
      place_ += velocity_ * dt;
      work_ += dot(force, velocity_) * dt;
    }
  }
  Vec3 place() const { return place_; }
  Vec3 velocity() const { return velocity_; }
  double work() const { return work_; }  // J that the force has done on it

 private:
  HandModel model_;
  Vec3 place_, velocity_;
  double work_ = 0;
};

}  // namespace karinui
