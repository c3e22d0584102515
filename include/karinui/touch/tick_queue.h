#pragma once
// A lock-free queue of ticks from the servo to one reader (single producer, single consumer; Lamport 1983). The servo
// never waits: what finds no room is dropped and counted. A button's press is not lost between two looks of a slow
// reader, as it would be where only the newest tick is seen.
#include <array>
#include <atomic>
#include <cstdint>

#include "karinui/touch/servo_step.h"

namespace karinui {

class TickQueue {
 public:
  static constexpr std::size_t kRoom = 1024;  // a second and a quarter of ordinary ticks
  static constexpr std::uint64_t kEvery = 4;  // of ticks without a change of buttons every fourth is kept

  // The servo's thread.
  void offer(const ServoTick& tick) {
    const bool changed = tick.hand.buttons != buttons_ || tick.hand.ready != ready_;
    if (!changed && ++since_ < kEvery) return;
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    // Ordinary ticks leave room for those that change something.
    const std::uint64_t room = kRoom - (end - begin_.load(std::memory_order_acquire));
    if (room == 0 || (!changed && room <= kRoom / 4)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ticks_[end % kRoom] = tick;
    end_.store(end + 1, std::memory_order_release);
    buttons_ = tick.hand.buttons, ready_ = tick.hand.ready, since_ = 0;
  }
  // The reader's thread: the oldest; false: there is none.
  bool take(ServoTick& tick) {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    tick = ticks_[begin % kRoom];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::array<ServoTick, kRoom> ticks_{};
  std::atomic<std::uint64_t> begin_{0}, end_{0}, dropped_{0};
  // The servo's only.
  std::uint32_t buttons_ = 0;
  bool ready_ = false;
  std::uint64_t since_ = 0;
};

}  // namespace karinui
