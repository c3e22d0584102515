#include "controller_mapper.h"

#include <cmath>

namespace karinui::room {

namespace {

constexpr double kFarthest = 3;  // metres a ray is drawn

}  // namespace

ControllerMapper::Mapped ControllerMapper::follow(const ControllerState& hand, PointerSample::Hand which,
                                                  const Around& around) {
  Mapped came;
  if (!hand.tracked) {
    unseen_ = true;  // a drag waits where it is
    return came;
  }
  const bool wasDown = down_;
  if (dropped_ && hand.trigger < kLetGo) dropped_ = false;
  down_ = !dropped_ && trigger_.follow(hand.trigger);
  if (std::exchange(unseen_, false) && wasDown && !down_) {
    came.lost = true;
    return came;
  }
  using Phase = PointerSample::Phase;
  const Phase phase = down_ ? (wasDown ? Phase::Drag : Phase::Press) : (wasDown ? Phase::Release : Phase::Hover);
  const bool underWay = phase == Phase::Drag || phase == Phase::Release;

  const Placement& placed = around.placement;
  Rigid tipInRoom = hand.aim;
  tipInRoom.carry += forwardOf(hand.aim) * kTipAhead;
  const Rigid tip = placed.roomToFitting(tipInRoom), standing = placed.roomToStand(tipInRoom);

  PointerSample ray;
  ray.phase = phase;
  ray.seconds = around.seconds;
  ray.ray = {tip.carry, forwardOf(tip)};
  ray.reach = kPointing;
  ray.trigger = hand.trigger;
  ray.grip = hand.hold;
  ray.second = hand.confirm;
  ray.device = PointerSample::Device::Controller;
  ray.hand = which;
  came.ray = {standing.carry, forwardOf(standing)};

  PointerSample touch = ray;
  touch.tip = tip;
  touch.reach = kTouching / placed.scale;

  const auto laid = [&](PointerSample sample, Flat place, double reach) {
    sample.where = PointerSample::Where::Table;
    sample.place = lastPlace_ = place;
    sample.reach = reach / around.table.paperScale();
    sample.tip.reset();
    return sample;
  };
  const PatternTable::Met below = around.table.below(standing.carry);
  const auto onBoard = around.table.meet(came.ray);

  if (!underWay) {
    const bool touchesBoard = below.within && std::fabs(below.along) < touch.reach;
    const bool touchesCloth = around.meets(touch).has_value();
    touches_ = touchesBoard || touchesCloth;
    const auto first = touches_ ? std::nullopt : around.meets(ray);
    onTable_ =
        touches_ ? touchesBoard && !touchesCloth : onBoard && onBoard->within && (!first || onBoard->along < *first);
    came.along = touches_ ? 0 : onTable_ ? onBoard->along : first.value_or(kFarthest);
  } else if (onTable_) {
    came.along = touches_ ? 0 : onBoard ? onBoard->along : kFarthest;
  } else {
    came.along = touches_ ? 0 : around.meets(ray).value_or(kFarthest);
  }
  came.touching = touches_;
  // Towards the eyes from what is pointed at, not from the hand: from there the hand's ray may lie in the plane.
  if (!underWay || touches_) meant_ = tip.carry + ray.ray.direction * came.along;
  const Vec3 facing = normalized(placed.roomToFitting(around.head) - meant_);
  ray.facing = touch.facing = facing == Vec3{} ? -ray.ray.direction : facing;
  if (!onTable_)
    came.sample = touches_ ? touch : ray;
  else if (touches_)
    came.sample = laid(touch, below.place, touch.reach);
  else  // a drag that points past the board's plane stays where it was
    came.sample = laid(ray, onBoard ? onBoard->place : lastPlace_,
                       kPointing * (onBoard ? std::min(onBoard->along, kFarthest) : 1));
  return came;
}

}  // namespace karinui::room
