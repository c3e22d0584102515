#pragma once
// A simulated hand at a session by a virtual clock: hand, force loop and session in one thread, the session as slow and
// as uneven as is asked for. The same run gives the same numbers.
#include <random>
#include <vector>

#include "karinui/devices/simulated_device.h"
#include "karinui/haptics/stepped_driver.h"

namespace karinui {

struct SessionRate {
  double hertz = 60;
  double jitter = 0;  // share of the period
  double stall = 0;   // seconds, now and then
};

class VirtualStylus {
 public:
  static constexpr double kTick = SteppedDriver::kTick;

  VirtualStylus(Session& session, Vec3 start, const ServoSettings& settings = {}, const SessionRate& rate = {},
                const HandModel& model = {0.2, 300, 8}, const DeviceRecord& device = simulatedRecord())
      : record(device),
        settings_(settings),
        rate_(rate),
        aim_(start),
        device_([this](double) { return aim_; }, record, model),
        driver_(session, device_, settings) {}

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
    for (const double end = now() + seconds; now() < end - kTick / 2;) tick();
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
    for (const double end = now() + kLongest; now() < end && there < 50;) {
      aim_ += (at - device_.hand().place()) * kAgainst;
      tick();
      there = distance(device_.hand().place(), at) < kThere ? there + 1 : 0;
    }
  }
  void press(bool down) {
    device_.buttons = down ? 1 : 0;
    wait(0.05);
  }
  double now() const { return driver_.now(); }
  const DeviceRecord record;

 private:
  void tick() {
    if (now() >= nextScene_) publish();
    const Vec3 before = device_.hand().place();
    const ServoTick tick = driver_.tick();
    const Vec3 force = tick.out.force, change = force - force_, at = tick.hand.tip.carry;
    const double slew = dot(change, force_) < 0 ? settings_.falling : settings_.rising;
    excess = std::max(excess, length(change) - slew * kTick - settings_.gain * record.stiffness * distance(before, at));
    force_ = force;
    most = std::max(most, length(force));
    work = std::max(work, device_.hand().work());
    moments.push_back({tick.seconds, at, tick.proxy, force, tick.touching, device_.buttons != 0, tick.fault});
  }
  void publish() {
    driver_.publish();
    facets = std::max(facets, driver_.scene()->facets.size());
    nextScene_ = now() + (1 + rate_.jitter * (2 * unit_(random_) - 1)) / rate_.hertz;
    if (rate_.stall > 0 && unit_(random_) < 0.05) nextScene_ += rate_.stall;
  }

  ServoSettings settings_;
  SessionRate rate_;
  Vec3 aim_, force_;
  SimulatedDevice device_;
  SteppedDriver driver_;
  double nextScene_ = 0;
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{0, 1};
};

}  // namespace karinui
