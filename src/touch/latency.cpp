#include "karinui/touch/latency.h"

#include <algorithm>
#include <cmath>

namespace karinui {

double LatencyHistogram::upper(std::size_t bucket) {
  if (bucket < kExact) return static_cast<double>(bucket + 1) * 1e-6;
  return 1e-3 * std::pow(kRatio, static_cast<double>(bucket - kExact + 1));
}

void LatencyHistogram::add(double seconds) {
  const double micro = std::max(0.0, seconds) * 1e6;
  std::size_t bucket = static_cast<std::size_t>(std::min(micro, 1e9));
  if (bucket >= kExact)
    bucket =
        kExact + std::min<std::size_t>(kSteps - 1, static_cast<std::size_t>(std::log(micro / 1e3) / std::log(kRatio)));
  buckets_[bucket].fetch_add(1, std::memory_order_relaxed);
  count_.fetch_add(1, std::memory_order_relaxed);
  if (seconds > longest()) longest_.store(seconds, std::memory_order_relaxed);
}

double LatencyHistogram::quantile(double share) const {
  const std::uint64_t all = count();
  if (all == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(all)));
  std::uint64_t so = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i)
    if (so += buckets_[i].load(std::memory_order_relaxed); so >= std::max<std::uint64_t>(1, wanted))
      return std::min(upper(i), longest());
  return longest();
}

void LatencyHistogram::clear() {
  for (auto& bucket : buckets_) bucket.store(0, std::memory_order_relaxed);
  count_ = 0;
  longest_ = 0;
}

}  // namespace karinui
