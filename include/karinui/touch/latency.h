#pragma once
// How long something took, counted without a lock: exact to a microsecond up to a millisecond, to 3 % beyond. One
// writer; any thread reads.
#include <array>
#include <atomic>
#include <cstdint>

namespace karinui {

class LatencyHistogram {
 public:
  void add(double seconds);
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
  double quantile(double share) const;  // seconds that so large a share did not exceed; 0 with nothing counted
  double longest() const { return longest_.load(std::memory_order_relaxed); }
  void clear();

 private:
  static constexpr std::size_t kExact = 1000, kSteps = 512;
  static constexpr double kRatio = 1.03;
  static double upper(std::size_t bucket);
  std::array<std::atomic<std::uint32_t>, kExact + kSteps> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<double> longest_{0};
};

}  // namespace karinui
