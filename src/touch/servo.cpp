#include "karinui/touch/servo.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <time.h>

#include <cmath>

namespace karinui {

namespace {

constexpr double kPeriod = 0.001;      // seconds
constexpr int kPriority = 20;          // of SCHED_FIFO: above ordinary work, below the system's own threads
constexpr std::uint64_t kWarm = 100;   // ticks until everything has been touched once
constexpr std::uint64_t kLooks = 256;  // ticks between two looks at the page faults

std::uint64_t pageFaultsOfThread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

// The pages of the stack that the loop will use.
[[gnu::noinline]] void touchStack() {
  volatile char pages[64 * 1024];
  for (std::size_t i = 0; i < sizeof pages; i += 1024) pages[i] = 0;
}

void sleepUntil(double seconds) {
  timespec until{};
  until.tv_sec = static_cast<time_t>(seconds);
  until.tv_nsec = static_cast<long>((seconds - static_cast<double>(until.tv_sec)) * 1e9);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

}  // namespace

double Servo::clock() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Servo::Servo(HapticDevice& device, const ServoSettings& settings, bool askRealTime)
    : device_(device), step_(device.record(), settings), gain_(settings.gain), limit_(settings.limit) {
  laws_.write(settings.laws);
  thread_ = std::thread([this, askRealTime] { run(askRealTime); });
}

Servo::~Servo() {
  stop_ = true;
  thread_.join();
  delete step_.adopt(nullptr, 0);
  delete step_.adopt(nullptr, 0);
}

void Servo::publish(std::unique_ptr<TouchScene> scene) {
  scene->version = ++versions_;
  scene->published = clock();
  exchange_.publish(std::move(scene));
}

Servo::Report Servo::report() const { return {count_, late_, ticks_.dropped(), pageFaults_, realTime_}; }

void Servo::run(bool askRealTime) {
  sched_param wish{};
  wish.sched_priority = kPriority;
  if (askRealTime) realTime_ = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wish) == 0;
  prctl(PR_SET_TIMERSLACK, 1UL);  // nanoseconds; for threads that are not real-time
  touchStack();
  std::uint64_t faultsBefore = 0;
  double published = 0;  // when what is felt was
  double next = clock();
  while (!stop_.load(std::memory_order_relaxed)) {
    next += kPeriod;
    sleepUntil(next);
    const double now = clock();
    lateness_.add(now - next);
    if (now - next > kPeriod) {
      late_.fetch_add(1, std::memory_order_relaxed);
      next = now;  // what was missed is not made up for
    }
    step_.setGain(gain_.load(std::memory_order_relaxed));
    step_.setLimit(limit_.load(std::memory_order_relaxed));
    step_.setFocus(focus_.load(std::memory_order_relaxed));
    if (TouchLaws laws; laws_.tryRead(laws)) step_.setLaws(laws);
    const bool off = off_.load(std::memory_order_relaxed);
    off ? step_.emergencyOff() : step_.takeOffBack();
    if (step_.mayAdopt(now) && exchange_.mayHandBack())
      if (const TouchScene* scene = exchange_.take()) {
        published = scene->published;
        exchange_.handBack(step_.adopt(scene, now));
      }

    const double asked = clock();
    const HandSample hand = device_.sample();
    const double began = clock();
    const ServoTick tick = step_.tick(hand, now);
    const double ended = clock();
    device_.apply(tick.out);
    evaluation_.add(ended - began);
    deviceTime_.add(began - asked + (clock() - ended));
    if (published > 0) sceneAge_.add(now - published);
    // By the device's button. Where it was off before, it may have been taken back during the tick.
    if (!off && tick.state == ServoState::Off) off_.store(true, std::memory_order_relaxed);
    told_.write(tick);
    ticks_.offer(tick);

    const std::uint64_t ticks = count_.fetch_add(1, std::memory_order_relaxed) + 1;
    if (ticks == kWarm) faultsBefore = pageFaultsOfThread();
    if (ticks > kWarm && ticks % kLooks == 0)
      pageFaults_.store(pageFaultsOfThread() - faultsBefore, std::memory_order_relaxed);
  }
  device_.apply({});
  device_.stop();
}

}  // namespace karinui
