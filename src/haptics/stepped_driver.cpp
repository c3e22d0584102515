#include "karinui/haptics/stepped_driver.h"

#include <algorithm>
#include <utility>

namespace karinui {

SteppedDriver::SteppedDriver(Session& session, HapticDevice& device, const ServoSettings& settings)
    : session_(session), device_(device), step_(device.record(), settings) {}

ServoTick SteppedDriver::tick() {
  if (waiting_ && step_.mayAdopt(now_)) {
    const TouchScene* done = step_.adopt(std::exchange(waiting_, nullptr), now_);
    std::erase_if(kept_, [&](const auto& scene) { return scene.get() == done; });
  }
  const HandSample hand = device_.sample();
  tip_ = hand.tip.carry;
  const ServoTick tick = step_.tick(hand, now_);
  proxy_ = tick.touching ? std::optional(tick.proxy) : std::nullopt;
  device_.apply(tick.out);
  ticks_.push_back(tick);
  now_ += kTick;
  return tick;
}

void SteppedDriver::publish(Vec3 facing) {
  for (const ServoTick& tick : std::exchange(ticks_, {})) {
    if (const auto sample = pointer_.of(tick, facing)) session_.feed(*sample);
    if (pointer_.takeLost()) session_.command(Command::Cancel);
  }
  if (const auto sample = pointer_.rest()) session_.feed(*sample);
  session_.finish();
  // One that the loop has not taken yet is replaced.
  std::erase_if(kept_, [&](const auto& scene) { return scene.get() == waiting_; });
  kept_.push_back(std::make_unique<TouchScene>(session_.touchSource().sceneAt(tip_, proxy_)));
  kept_.back()->published = now_;
  waiting_ = kept_.back().get();
}

}  // namespace karinui
