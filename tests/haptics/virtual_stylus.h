#pragma once
// A simulated hand at a session by a virtual clock: hand, force loop and session in one thread, the session as slow and
// as uneven as is asked for. The same run gives the same numbers.
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "karinui/devices/simulated_device.h"
#include "karinui/haptics/stylus_pointer.h"
#include "karinui/session/session.h"

namespace karinui {

struct SessionRate {
  double hertz = 60;
  double jitter = 0;  // share of the period
  double stall = 0;   // seconds, now and then
};

class VirtualStylus {
 public:
  static constexpr double kTick = 0.001;  // seconds

  VirtualStylus(Session& session, Vec3 start, const ServoSettings& settings = {}, const SessionRate& rate = {},
                const HandModel& model = {0.2, 300, 8}, const DeviceRecord& device = simulatedRecord())
      : record(device),
        session_(session),
        settings_(settings),
        rate_(rate),
        step_(record, settings),
        hand_(start, model),
        aim_(start) {}

  // What is seen meanwhile.
  struct Moment {
    double seconds = 0;
    Vec3 tip, proxy, force;
    bool touching = false, down = false;
    ServoFault fault = ServoFault::None;
  };
  std::vector<Moment> moments;
  double most = 0, excess = 0,
         work = 0;  // N; N beyond the slew rate limit in a tick; J that the hand was given, at most
  std::size_t facets = 0;

  void wait(double seconds) {
    for (const double end = now_ + seconds; now_ < end - kTick / 2;) tick();
  }
  // The hand means to go there, evenly.
  void go(Vec3 to, double speed = 0.15) {
    const Vec3 from = aim_;
    const int ticks = std::max(1, static_cast<int>(distance(from, to) / speed / kTick));
    for (int k = 1; k <= ticks; ++k) {
      aim_ = lerp(from, to, static_cast<double>(k) / ticks);
      tick();
    }
  }
  // A person who sees where the tip is: means to be elsewhere, against the force, until the hand is there.
  void arrive(Vec3 at) {
    constexpr double kAgainst = 4 * kTick, kThere = 1e-5, kLongest = 4;  // share a tick, metres, seconds
    int there = 0;
    for (const double end = now_ + kLongest; now_ < end && there < 50;) {
      aim_ += (at - hand_.place()) * kAgainst;
      tick();
      there = distance(hand_.place(), at) < kThere ? there + 1 : 0;
    }
  }
  void press(bool down) {
    buttons_ = down ? 1 : 0;
    wait(0.05);
  }
  double now() const { return now_; }
  const DeviceRecord record;

 private:
  void tick() {
    if (now_ >= nextScene_) publish();
    if (waiting_ && step_.mayAdopt(now_)) step_.adopt(std::exchange(waiting_, nullptr), now_);
    const Vec3 before = hand_.place();
    hand_.step(aim_, force_, kTick);
    HandSample sample;
    sample.tip.carry = hand_.place();
    sample.velocity = hand_.velocity();
    sample.buttons = buttons_;
    sample.ready = true;
    const ServoTick tick = step_.tick(sample, now_);
    const Vec3 force = tick.out.force, change = force - force_;
    const double slew = dot(change, force_) < 0 ? settings_.falling : settings_.rising;
    excess = std::max(
        excess, length(change) - slew * kTick - settings_.gain * record.stiffness * distance(before, hand_.place()));
    force_ = force;
    most = std::max(most, length(force));
    work = std::max(work, hand_.work());
    ticks_.push_back(tick);
    moments.push_back({now_, sample.tip.carry, tick.proxy, force, tick.touching, buttons_ != 0, tick.fault});
    now_ += kTick;
  }
  void publish() {
    for (const ServoTick& tick : ticks_)
      if (const auto one = pointer_.of(tick, {0, 0, 1})) session_.feed(*one);
    ticks_.clear();
    if (const auto one = pointer_.rest()) session_.feed(*one);
    session_.finish();
    kept_.push_back(std::make_unique<TouchScene>(session_.touchSource().sceneAt(hand_.place())));
    kept_.back()->published = now_;
    facets = std::max(facets, kept_.back()->facets.size());
    waiting_ = kept_.back().get();
    nextScene_ = now_ + (1 + rate_.jitter * (2 * unit_(random_) - 1)) / rate_.hertz;
    if (rate_.stall > 0 && unit_(random_) < 0.05) nextScene_ += rate_.stall;
  }

  Session& session_;
  ServoSettings settings_;
  SessionRate rate_;
  ServoStep step_;
  StylusPointer pointer_;
  SimulatedHand hand_;
  Vec3 aim_, force_;
  std::uint32_t buttons_ = 0;
  double now_ = 0, nextScene_ = 0;
  std::vector<std::unique_ptr<TouchScene>> kept_;
  const TouchScene* waiting_ = nullptr;
  std::vector<ServoTick> ticks_;
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{0, 1};
};

}  // namespace karinui
