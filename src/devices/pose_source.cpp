#include "karinui/devices/pose_source.h"

#include <algorithm>

namespace karinui {

namespace {

constexpr double kGlide = 0.8;  // m/s
constexpr double kShare = 0.1;  // of the way left in a tick: events a hundredth of a second apart become one motion

Rigid between(const Rigid& a, const Rigid& b, double share) {
  const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1 : 1;
  const auto mixed = [&](double from, double to) { return from * (1 - share) + sign * to * share; };
  Rigid r{mixed(a.w, b.w), mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.z, b.z), lerp(a.carry, b.carry, share)};
  const double size = std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
  if (!(size > 0)) return {1, 0, 0, 0, r.carry};
  r.w /= size, r.x /= size, r.y /= size, r.z /= size;
  return r;
}

}  // namespace

DeviceRecord shownRecord(std::string name) {
  DeviceRecord record;
  record.name = std::move(name);
  record.force = 3.75;  // 0.8 of it are the default limit of 3 N
  record.stiffness = 400;
  record.damping = 4;
  return record;
}

PoseSource::PoseSource(DeviceRecord record) : record_(std::move(record)) {}

void PoseSource::place(const Rigid& tip, std::uint32_t buttons, double trigger) {
  HandSample wanted;
  wanted.tip = tip;
  wanted.buttons = buttons;
  wanted.trigger = trigger;
  wanted.ready = true;
  wanted_.write(wanted);
}

void PoseSource::leave() { wanted_.write({}); }

HandSample PoseSource::sample() {
  wanted_.tryRead(aim_);
  if (!aim_.ready) placed_ = false;
  if (!aim_.ready) return aim_;
  const Vec3 before = placed_ ? now_.tip.carry : aim_.tip.carry;
  const double left = distance(before, aim_.tip.carry);
  const double share = !placed_ ? 1 : left > 0 ? std::min(kShare, kGlide * kServoTick / left) : kShare;
  Rigid tip = between(placed_ ? now_.tip : aim_.tip, aim_.tip, share);
  now_ = aim_;
  now_.tip = tip;
  now_.velocity = (tip.carry - before) * (1 / kServoTick);
  placed_ = true;
  return now_;
}

Result<ScriptedDevice> ScriptedDevice::read(std::string_view text, const DeviceRecord& record, double tick,
                                            double rest) {
  ScriptedDevice device;
  device.record_ = record;
  device.tick_ = tick;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.find(" tip ") == std::string_view::npos || line.front() == '#') continue;
    const auto sample = parsePointerSample(line);
    if (!sample) return badInput(say("Line {0}: {1}", number, sample.error().what));
    if (!device.samples_.empty() && sample->seconds < device.samples_.back().seconds)
      return badInput(say("Line {0}: {1}", number, say("A recorded hand goes on in time.")));
    if (!device.samples_.empty() && !(sample->seconds - device.begins() <= kLongestHand))
      return badInput(say("Line {0}: {1}", number, say("A recorded hand lasts a day at most.")));
    const Rigid& tip = *sample->tip;
    const double size = std::sqrt(tip.w * tip.w + tip.x * tip.x + tip.y * tip.y + tip.z * tip.z);
    if (!(std::fabs(size - 1) < 1e-3))
      return badInput(say("Line {0}: {1}", number, say("How the tip is turned is no unit quaternion.")));
    device.samples_.push_back(*sample);
  }
  if (device.samples_.empty())
    return badInput(say("This recording has no tip in space; record it with a stylus or a controller."));
  device.now_ = device.begins() - rest - tick;
  return device;
}

HandSample ScriptedDevice::sample() {
  now_ += tick_;
  HandSample hand;
  if (now_ < begins() - tick_ / 2) {
    hand.tip = *samples_.front().tip;
    hand.ready = true;
    return hand;
  }
  while (at_ + 1 < samples_.size() && samples_[at_ + 1].seconds <= now_) ++at_;
  const PointerSample& from = samples_[at_];
  const PointerSample& to = samples_[std::min(at_ + 1, samples_.size() - 1)];
  const double span = to.seconds - from.seconds;
  hand.tip = between(*from.tip, *to.tip, span > 0 ? std::clamp((now_ - from.seconds) / span, 0.0, 1.0) : 0);
  if (span > 0) hand.velocity = (to.tip->carry - from.tip->carry) * (1 / span);
  using Phase = PointerSample::Phase;
  hand.buttons = (from.phase == Phase::Press || from.phase == Phase::Drag ? 1u : 0u) | (from.second ? 2u : 0u);
  hand.trigger = from.trigger;
  hand.ready = now_ <= ends() + tick_ / 2;
  return hand;
}

}  // namespace karinui
