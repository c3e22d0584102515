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

void PlacedDevice::place(const Placement& placement) {
  wanted_.write(placement);
  wishes_.fetch_add(1, std::memory_order_release);
}

HandSample PlacedDevice::sample() {
  if (const std::uint32_t wishes = wishes_.load(std::memory_order_acquire); wishes != taken_)
    if (Placement wanted; wanted_.tryRead(wanted)) {
      wanted.scale = placement_.scale;
      placement_ = wanted;
      taken_ = wishes;
    }
  HandSample hand = inner_.sample();
  const Vec3 device = hand.tip.carry;
  Rigid scene = after(placement_.turn, hand.tip);
  scene.carry = placement_.toScene(device);
  hand.velocity = placement_.turn.turned(hand.velocity) * placement_.scale;
  const bool clutch = (hand.buttons & clutchButtons_) != 0;
  if (clutch && !clutched_) held_ = scene;
  if (clutched_) {  // also in the tick it is let go
    placement_ = placement_.broughtTo(device, held_.carry);
    scene.carry = held_.carry;
  }
  if (clutch) hand.velocity = {};
  clutched_ = clutch;
  hand.tip = scene;
  return hand;
}

void PlacedDevice::apply(const HandForce& force) {
  const Rigid turn = back(placement_.turn);
  inner_.apply({turn.turned(force.force), turn.turned(force.torque), force.vibration});
}

}  // namespace karinui
