#include "karinui/haptics/hand_recording.h"

#include <cmath>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kMoved = 2e-5;    // metres, and
constexpr double kForce = 0.005;   // newtons: less is nothing new,
constexpr double kLongest = 0.02;  // but for so many seconds
constexpr double kUnit = 1e-6;     // metres, and parts of a quaternion, to which places are written

double rounded(double x) { return std::round(x / kUnit) * kUnit + 0.0; }
Vec3 rounded(Vec3 p) { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }
Rigid rounded(const Rigid& r) {
  Rigid out = r;
  out.w = rounded(r.w), out.x = rounded(r.x), out.y = rounded(r.y), out.z = rounded(r.z);
  out.carry = rounded(r.carry);
  return out;
}

std::string numbers(Vec3 p, int decimals) {
  return " " + fixed(p.x, decimals) + " " + fixed(p.y, decimals) + " " + fixed(p.z, decimals);
}

bool bringsNew(const ServoTick& from, const ServoTick& to) {
  return to.seconds - from.seconds >= kLongest || from.hand.buttons != to.hand.buttons ||
         distance(from.hand.tip.carry, to.hand.tip.carry) >= kMoved || distance(from.out.force, to.out.force) >= kForce;
}

}  // namespace

HandRecording::HandRecording(std::filesystem::path path, const StylusSettings& settings)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::trunc), settings_(settings) {
  file_ << "# A recorded hand of Karinui. m, s, N, y up.\n"
           "# felt: seconds, tip x y z, proxy x y z, force on the hand x y z, touching 0 or 1\n";
}

Result<std::unique_ptr<HandRecording>> HandRecording::begin(const std::filesystem::path& path,
                                                            const StylusSettings& settings) {
  std::unique_ptr<HandRecording> made(new HandRecording(path, settings));
  if (const Done done = made->end(); !done) return done.error();
  return made;
}

void HandRecording::tool(std::string_view name) {
  if (name == tool_) return;
  tool_ = name;
  file_ << "tool " << name << "\n";
}

void HandRecording::tick(const ServoTick& tick, Vec3 facing) {
  using Phase = PointerSample::Phase;
  if (!tick.hand.ready || (written_ && !bringsNew(*written_, tick))) return;
  if (!began_) began_ = tick.seconds;
  const auto pressed = [&](const ServoTick& t) { return (t.hand.buttons & settings_.mainButtons) != 0; };
  const bool down = pressed(tick), was = written_ && pressed(*written_);
  PointerSample sample;
  sample.phase = down ? was ? Phase::Drag : Phase::Press : was ? Phase::Release : Phase::Hover;
  sample.device = PointerSample::Device::Stylus;
  sample.hand = settings_.hand;
  sample.reach = settings_.reach;
  sample.seconds = rounded(tick.seconds - *began_);
  sample.facing = rounded(facing);
  sample.trigger = rounded(tick.hand.trigger);
  sample.second = (tick.hand.buttons & settings_.secondButtons) != 0;
  sample.tip = rounded(tick.hand.tip);
  sample.ray = {sample.tip->carry, rounded(tick.hand.tip.turned({0, 0, -1}))};
  const Vec3 proxy = tick.touching ? tick.proxy : tick.hand.tip.carry;
  file_ << text(sample) << "\nfelt " << fixed(sample.seconds, 6) << numbers(tick.hand.tip.carry, 6) << numbers(proxy, 6)
        << numbers(tick.out.force, 4) << (tick.touching ? " 1" : " 0") << "\n";
  written_ = tick;
}

Done HandRecording::end() {
  file_.flush();
  if (file_) return {};
  return storageError(
      say("The hand cannot be recorded in {0}: look whether its folder is there, may be written and has room.",
          path_.string()));
}

}  // namespace karinui
