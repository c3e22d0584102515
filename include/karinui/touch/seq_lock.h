#pragma once
// One writer shows its newest value to any number of readers: the writer never waits, a reader reads again where it was
// overtaken (Boehm 2012). T is trivially copyable.
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace karinui {

template <class T>
class SeqLock {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void write(const T& value) {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(T));
    const std::uint64_t turn = turn_.load(std::memory_order_relaxed);
    turn_.store(turn + 1, std::memory_order_relaxed);
    // Released, so that none is seen before the odd turn.
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    turn_.store(turn + 2, std::memory_order_release);
  }
  // Never waits: false, and nothing changed, where the writer is at it. For a reader that may have overtaken the
  // writer's thread on its own processor.
  bool tryRead(T& value) const {
    std::array<std::uint64_t, kWords> words;
    const std::uint64_t before = turn_.load(std::memory_order_acquire);
    for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
    if (before % 2 != 0 || turn_.load(std::memory_order_acquire) != before) return false;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }
  T read() const {
    T value;
    while (!tryRead(value)) {
    }
    return value;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  std::atomic<std::uint64_t> turn_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace karinui
