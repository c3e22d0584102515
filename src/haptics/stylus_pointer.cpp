#include "karinui/haptics/stylus_pointer.h"

namespace karinui {

namespace {

constexpr double kStride = 0.002;  // metres between two places of a drag that are fed for themselves
constexpr double kStill = 1e-5;    // metres: less is no motion
constexpr double kTurned = 1e-4;   // of the quaternion's parts

bool moved(const PointerSample& from, const PointerSample& to, double far) {
  const Rigid &a = *from.tip, &b = *to.tip;
  if (distance(a.carry, b.carry) >= far || from.second != to.second) return true;
  return std::fabs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z) < 1 - kTurned;
}

}  // namespace

std::optional<PointerSample> StylusPointer::of(const ServoTick& tick, Vec3 facing) {
  using Phase = PointerSample::Phase;
  if (!tick.hand.ready) {
    lost_ = lost_ || down_;
    stuck_ = true;
    down_ = false;
    fed_.reset(), waiting_.reset();
    return std::nullopt;
  }
  PointerSample sample;
  sample.device = PointerSample::Device::Stylus;
  sample.hand = settings_.hand;
  sample.reach = settings_.reach;
  sample.seconds = tick.seconds;
  sample.facing = facing;
  sample.trigger = tick.hand.trigger;
  sample.second = (tick.hand.buttons & settings_.secondButtons) != 0;
  sample.tip = tick.hand.tip;
  if (tick.touching) sample.tip->carry = tick.proxy;
  sample.ray = {sample.tip->carry, sample.tip->turned({0, 0, -1})};
  const bool pressed = (tick.hand.buttons & settings_.mainButtons) != 0;
  stuck_ = stuck_ && pressed;
  const bool down = pressed && !stuck_, was = std::exchange(down_, down);
  sample.phase = down ? was ? Phase::Drag : Phase::Press : was ? Phase::Release : Phase::Hover;
  const bool turning = down != was;
  if (!turning && fed_ && !moved(*fed_, sample, kStill)) {
    waiting_.reset();
    return std::nullopt;
  }
  if (!turning && fed_ && (!down || !moved(*fed_, sample, kStride))) {
    waiting_ = sample;
    return std::nullopt;
  }
  waiting_.reset();
  return fed_ = sample;
}

std::optional<PointerSample> StylusPointer::rest() {
  if (waiting_) fed_ = waiting_;
  return std::exchange(waiting_, std::nullopt);
}

}  // namespace karinui
