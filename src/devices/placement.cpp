#include "karinui/devices/placement.h"

#include "karinui/base/result.h"

namespace karinui {

namespace {

Rigid back(const Rigid& turn) { return {turn.w, -turn.x, -turn.y, -turn.z, {}}; }

}  // namespace

Placement Placement::broughtTo(Vec3 device, Vec3 scene) const {
  Placement placed = *this;
  placed.sceneCentre += scene - toScene(device);
  return placed;
}

PlacedDevice::PlacedDevice(HapticDevice& inner, const Placement& placement, std::uint32_t clutchButtons,
                           DeviceRecord::Hand hand)
    : inner_(inner), record_(inner.record()), clutchButtons_(clutchButtons), placement_(placement) {
  KARINUI_ASSERT(placement.scale > 0);
  record_.scale *= placement.scale;
  record_.stiffness /= placement.scale;
  record_.damping /= placement.scale;
  record_.hand = hand;
  record_.workspace = {};
  const Box& box = inner.record().workspace;
  if (!box.empty())
    for (int k = 0; k < 8; ++k)
      record_.workspace.include(placement.toScene(
          {k & 1 ? box.low.x : box.high.x, k & 2 ? box.low.y : box.high.y, k & 4 ? box.low.z : box.high.z}));
}

void PlacedDevice::place(const Placement& placement) { place_.wish(placement); }

HandSample PlacedDevice::sample() {
  HandSample hand = inner_.sample();
  const Vec3 device = hand.tip.carry;
  if (Placement wanted; place_.take(wanted)) {
    wanted.scale = placement_.scale;
    placement_ = wanted;
  }
  if (Rigid turn; turn_.take(turn)) {
    const Vec3 tip = placement_.toScene(device);
    placement_.turn = turn;
    placement_ = placement_.broughtTo(device, tip);
  }
  if (Vec3 to; bring_.take(to)) placement_ = placement_.broughtTo(device, to), held_.carry = to;
  Rigid scene = after(placement_.turn, hand.tip);
  scene.carry = placement_.toScene(device);
  hand.velocity = placement_.turn.turned(hand.velocity) * placement_.scale;
  const bool clutch = (hand.buttons & clutchButtons_) != 0;
  if (clutch && !clutched_) held_ = scene;
  if (clutched_) {  // also in the tick it is let go
    led_ += placement_.turn.turned(device - before_) * placement_.scale;
    placement_ = placement_.broughtTo(device, held_.carry);
    scene.carry = held_.carry;
  }
  if (clutch) hand.velocity = {};
  clutched_ = clutch;
  before_ = device;
  hand.led = led_;
  hand.tip = scene;
  return hand;
}

void PlacedDevice::apply(const HandForce& force) {
  const Rigid turn = back(placement_.turn);
  inner_.apply({turn.turned(force.force), turn.turned(force.torque), force.vibration});
}

}  // namespace karinui
