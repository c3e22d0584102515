#pragma once
// The force loop: a thread of its own at 1 kHz around a ServoStep. In the loop there are no locks, no allocation and no
// page faults; it shares nothing with other threads but atomics. Real-time scheduling (SCHED_FIFO) is used where the
// system permits it. Each of publish(), takeTick() and setLaws() from one thread, the others from any.
#include <atomic>
#include <memory>
#include <thread>

#include "karinui/touch/latency.h"
#include "karinui/touch/scene_exchange.h"
#include "karinui/touch/seq_lock.h"
#include "karinui/touch/servo_step.h"
#include "karinui/touch/tick_queue.h"

namespace karinui {

class Servo {
 public:
  // The device must outlive it. It begins at once, with no scene, and so with no force.
  Servo(HapticDevice& device, const ServoSettings& settings = {}, bool askRealTime = true);
  ~Servo();  // stops the device
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  static double clock();                            // seconds; what `published` is measured by
  void publish(std::unique_ptr<TouchScene> scene);  // sets its version and time
  ServoTick last() const { return told_.read(); }   // the newest tick
  // What the hand did since the last time, oldest first; from one thread. False: nothing more.
  bool takeTick(ServoTick& tick) { return ticks_.take(tick); }
  void setGain(double gain) { gain_.store(gain); }
  void setLimit(double newtons) { limit_.store(newtons); }
  void setLaws(const TouchLaws& laws) { laws_.write(laws); }
  void setFocus(bool focus) { focus_.store(focus); }
  void emergencyOff() { off_.store(true); }
  void takeOffBack() { off_.store(false); }
  bool isOff() const { return off_.load(); }

  struct Report {
    std::uint64_t ticks = 0, late = 0;  // late: by more than a millisecond
    std::uint64_t dropped = 0;          // ticks that nobody took in time
    std::uint64_t pageFaults = 0;       // since it was warm
    bool realTime = false;              // SCHED_FIFO was permitted
  };
  Report report() const;
  const LatencyHistogram& lateness() const { return lateness_; }      // of waking up
  const LatencyHistogram& evaluation() const { return evaluation_; }  // of one ServoStep::tick
  const LatencyHistogram& exchange() const { return deviceTime_; }    // with the device: of sample() and apply()
  const LatencyHistogram& sceneAge() const { return sceneAge_; }      // since what is felt was published

 private:
  void run(bool askRealTime);
  HapticDevice& device_;
  ServoStep step_;  // the thread's only
  SceneExchange exchange_;
  SeqLock<ServoTick> told_;
  SeqLock<TouchLaws> laws_;
  TickQueue ticks_;
  LatencyHistogram lateness_, evaluation_, deviceTime_, sceneAge_;
  std::atomic<double> gain_, limit_;
  std::atomic<bool> focus_{true}, off_{false}, stop_{false}, realTime_{false};
  std::atomic<std::uint64_t> count_{0}, late_{0}, pageFaults_{0};
  std::uint64_t versions_ = 0;  // the publisher's only
  std::thread thread_;          // last: it begins when all else is there
};

}  // namespace karinui
