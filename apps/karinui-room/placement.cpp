#include "placement.h"

#include <cmath>

namespace karinui::room {

namespace {

constexpr double kAway = 1.1;          // metres from the eyes to the body's middle at 1:1,
constexpr double kDeskAway = 0.62;     // and at table-top scale
constexpr double kDeskBelow = 0.52;    // metres from the eyes down to the desk
constexpr double kFitterEyes = 1.5;    // metres above the floor: someone who stands before a figure
constexpr double kUnknownFloor = 1.6;  // metres below the eyes, where the headset knows no floor
constexpr double kNearestTurn = 0.06;  // metres from the axis within which a hand's angle means nothing

Rigid turned(const Rigid& pose, double radians) { return after(turnAbout({0, 1, 0}, radians), pose); }

}  // namespace

Vec3 turnedAboutUp(Vec3 p, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}

Vec3 forwardOf(const Rigid& pose) { return pose.turned({0, 0, -1}); }

double headingOf(const Rigid& pose) {
  Vec3 ahead = forwardOf(pose);
  // Looking straight up or down: the crown tells where the front is.
  if (std::hypot(ahead.x, ahead.z) < 1e-3) ahead = pose.turned({0, ahead.y > 0 ? -1.0 : 1.0, 0});
  return std::atan2(-ahead.x, -ahead.z);
}

Vec3 Placement::standToRoom(Vec3 p) const { return foot + turnedAboutUp(p, heading) * scale; }
Vec3 Placement::roomToStand(Vec3 p) const { return turnedAboutUp(p - foot, -heading) * (1 / scale); }
Vec3 Placement::fittingToStand(Vec3 p) const { return turnedAboutUp(p, turn); }
Vec3 Placement::standToFitting(Vec3 p) const { return turnedAboutUp(p, -turn); }

Rigid Placement::roomToStand(const Rigid& pose) const {
  Rigid there = turned(pose, -heading);
  there.carry = roomToStand(pose.carry);
  return there;
}
Rigid Placement::roomToFitting(const Rigid& pose) const {
  Rigid there = turned(pose, -heading - turn);
  there.carry = roomToFitting(pose.carry);
  return there;
}

Placement placedBefore(const Rigid& head, Scale scale, const Posture& posture) {
  Placement placed;
  placed.heading = headingOf(head);
  const Vec3 ahead = turnedAboutUp({0, 0, -1}, placed.heading);
  if (scale == Scale::TableTop) {
    placed.scale = kTableTopScale;
    placed.foot = head.carry + ahead * kDeskAway;
    placed.foot.y = head.carry.y - kDeskBelow;
    return placed;
  }
  placed.foot = head.carry + ahead * kAway;
  placed.foot.y = posture.seated  ? head.carry.y - kFitterEyes
                  : posture.floor ? *posture.floor
                                  : head.carry.y - kUnknownFloor;
  return placed;
}

bool GrabLocomotion::follow(Placement& placement, const Hand& tool, const Hand& other) {
  const Placement before = placement;
  if (tool.held && !carrying_) from_ = tool.place, footFrom_ = placement.foot;
  carrying_ = tool.held;
  if (carrying_) {
    Vec3 by = tool.place - from_;
    if (placement.scale == 1) by.y = 0;
    placement.foot = footFrom_ + by;
  }
  const Vec3 arm = other.place - placement.foot;
  const bool tells = std::hypot(arm.x, arm.z) > kNearestTurn * placement.scale;
  const double angle = std::atan2(arm.x, arm.z);
  if (other.held && tells) {
    if (!turning_) angleFrom_ = angle, turnFrom_ = placement.turn;
    placement.turn = turnFrom_ + std::remainder(angle - angleFrom_, 2 * 3.14159265358979323846);
  }
  turning_ = other.held && (turning_ || tells);
  return !(placement.foot == before.foot) || placement.turn != before.turn;
}

}  // namespace karinui::room
