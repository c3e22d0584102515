// The thread of the servo: what it must not do while it runs is counted.
#include "karinui/touch/servo.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cstdlib>
#include <limits>
#include <new>

#include "touch/hand.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KARINUI_SANITIZED 1
#endif

namespace {
thread_local bool watched = false;  // this thread is in the force loop
std::atomic<int> allocations{0}, locks{0};
}  // namespace

#ifndef KARINUI_SANITIZED
// Every way to the heap, and every lock, of the whole program.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void __libc_free(void* old);
void* malloc(std::size_t size) {
  if (watched) ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  if (watched) ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  if (watched) ++allocations;
  return __libc_realloc(old, size);
}
void free(void* old) {
  if (watched && old) ++allocations;
  __libc_free(old);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  if (watched) ++locks;
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return real(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
  if (watched) ++locks;
  using Lock = int (*)(pthread_rwlock_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_rwlock_rdlock"));
  return real(lock);
}
}
#endif

namespace karinui {
namespace {

// Presses on the floor, and watches its thread between the first tick and the last of `ticks`.
class Watching : public HapticDevice {
 public:
  explicit Watching(int ticks) : ticks_(ticks) {}
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override {
    const int tick = tick_.load();
    watched = tick >= 200 && tick < ticks_;
    if (mistake && tick == 300) {
      int* volatile lost = new int(tick);
      delete lost;
    }
    if (mistake && tick == 300) pthread_mutex_lock(&mutex_), pthread_mutex_unlock(&mutex_);
    return handAt({0, tick < 1000 ? 0.005 : -0.003, 0});
  }
  void apply(const HandForce& force) override {
    felt = std::max(felt.load(), length(force.force));
    last = force;
    if (tick_.fetch_add(1) + 1 == ticks_) watched = false, done = true;
    tick_.notify_all();
  }
  void stop() override { watched = false, ++stops; }
  void wait() const {
    while (!done) tick_.wait(tick_.load());
  }
  bool mistake = false;
  std::atomic<double> felt{0};
  HandForce last;
  std::atomic<int> stops{0};
  std::atomic<bool> done{false};

 private:
  DeviceRecord record_ = touchRecord();
  int ticks_;
  std::atomic<int> tick_{0};
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
};

#ifndef KARINUI_SANITIZED
// Runs the loop for 1500 ticks, with a new scene, of its own memory, all the while; says the page faults in it.
std::uint64_t pageFaultsOfRun(Watching& device) {
  allocations = locks = 0;
  ServoSettings settings;
  settings.rampSeconds = 0.1;
  settings.latest = settings.stalest = 1e9;  // a busy machine is not what is tested here
  settings.farthestJump = settings.fastest = 1e9;
  Servo servo(device, settings);
  while (!device.done) {
    servo.publish(std::make_unique<TouchScene>(floorScene()));
    for (int k = 0; k < 10 && !device.done; ++k) std::this_thread::yield();
  }
  EXPECT_GE(servo.report().ticks, 1499u);  // the last one may still be on its way into the count
  return servo.report().pageFaults;
}

TEST(Servo, NeitherLocksNorAllocatesNorFaultsInTheLoop) {
  for (const bool mistake : {false, true}) {
    // The kernel may move a page (compaction) while the loop runs; what faults by itself does so in each run.
    std::uint64_t fewestPageFaults = std::numeric_limits<std::uint64_t>::max();
    for (int run = 0; run < 3 && fewestPageFaults > 0; ++run) {
      Watching device(1500);
      device.mistake = mistake;
      fewestPageFaults = std::min(fewestPageFaults, pageFaultsOfRun(device));
      EXPECT_GT(device.felt, 0.3) << "the loop has worked";
      EXPECT_EQ(device.stops, 1);
      EXPECT_EQ(length(device.last.force), 0) << "nothing is left in the hand";
      EXPECT_EQ(allocations, mistake ? 2 : 0);
      EXPECT_EQ(locks, mistake ? 1 : 0);
    }
    EXPECT_EQ(fewestPageFaults, 0u);
  }
}
#endif

TEST(Servo, CountsItsTicksAndTellsTheNewest) {
  Watching device(200);
  Servo servo(device);
  servo.publish(std::make_unique<TouchScene>(floorScene()));
  device.wait();
  EXPECT_GE(servo.lateness().count(), 200u);
  EXPECT_GE(servo.evaluation().count(), 199u);
  EXPECT_EQ(servo.last().hand.tip.carry.y, 0.005);
  servo.emergencyOff();
  while (servo.last().state != ServoState::Off) std::this_thread::yield();
  EXPECT_TRUE(servo.isOff());
  servo.takeOffBack();
  while (servo.last().state == ServoState::Off) std::this_thread::yield();
}

// Takes the emergency off back while a tick that is still off is under way.
class TakesBack : public HapticDevice {
 public:
  const DeviceRecord& record() const override { return record_; }
  HandSample sample() override {
    HandSample hand = handAt({0, 0.005, 0});
    hand.buttons = pressed.exchange(false) ? 8 : 0;
    return hand;
  }
  void apply(const HandForce&) override {
    Servo* const taking = servo.load();
    if (taking && taking->isOff() && ++ticksOff == 3) taking->takeOffBack();
  }
  void stop() override {}
  std::atomic<Servo*> servo{nullptr};
  std::atomic<bool> pressed{false};
  std::atomic<int> ticksOff{0};

 private:
  DeviceRecord record_ = touchRecord();
};

TEST(Servo, AnEmergencyOffThatIsTakenBackDuringATickStaysTakenBack) {
  TakesBack device;
  ServoSettings settings;
  settings.offButtons = 8;
  Servo servo(device, settings);
  device.servo = &servo;
  device.pressed = true;  // by its button
  while (device.ticksOff < 3) std::this_thread::yield();
  const std::uint64_t then = servo.report().ticks;
  while (servo.report().ticks < then + 20) std::this_thread::yield();
  EXPECT_FALSE(servo.isOff());
  EXPECT_NE(servo.last().state, ServoState::Off);
  device.servo = nullptr;
}

TEST(SceneExchange, EveryVersionIsFreedOutsideTheLoop) {
  SceneExchange exchange;
  ServoStep step(touchRecord());
  double now = 0;
  for (int k = 0; k < 1000; ++k) {
    auto scene = std::make_unique<TouchScene>(floorScene());
    scene->version = static_cast<std::uint64_t>(k);
    scene->published = now;
    exchange.publish(std::move(scene));
    for (int tick = 0; tick < k % 40; ++tick) {
      now += 0.001;
      if (step.mayAdopt(now) && exchange.mayHandBack())
        if (const TouchScene* taken = exchange.take()) exchange.handBack(step.adopt(taken, now));
      step.tick(handAt({0, 0.01, 0}), now);
    }
  }
  exchange.handBack(step.adopt(nullptr, now));
  exchange.handBack(step.adopt(nullptr, now));
  EXPECT_GT(exchange.freed(), 300u);  // under the address sanitizer: none is lost, none is used after
}

TEST(Latency, QuantilesAreThoseOfTheSortedList) {
  LatencyHistogram histogram;
  for (int k = 1; k <= 1000; ++k) histogram.add(k * 1e-6 - 5e-7);
  EXPECT_NEAR(histogram.quantile(0.5), 500e-6, 1e-9);
  EXPECT_NEAR(histogram.quantile(0.99), 990e-6, 1e-9);
  histogram.add(0.145);
  EXPECT_NEAR(histogram.quantile(1), 0.145, 1e-12);
  EXPECT_NEAR(histogram.longest(), 0.145, 1e-12);
}

}  // namespace
}  // namespace karinui
