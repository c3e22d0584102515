#include "cloth/approach_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace karinui {
namespace {

constexpr std::int64_t kFarthest = 4;  // cells: nodes that go so far that cells farther apart may meet are not bounded

}  // namespace

void ApproachBound::make(std::span<const Vec3> x, double side) {
  from_.assign(x.begin(), x.end());
  list_ = CellList(x, side);
  cells_.clear();
  index_.assign(list_.nodes.start.size() - 1, kNoNode);
  for (std::int64_t k = 0; k < list_.count[2]; ++k)
    for (std::int64_t j = 0; j < list_.count[1]; ++j)
      for (std::int64_t i = 0; i < list_.count[0]; ++i) {
        const auto number = static_cast<std::uint32_t>(list_.number(i, j, k));
        if (!list_.nodes.any(number)) continue;
        index_[number] = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back({{i, j, k}, number});
      }
}

ApproachBound::Ways ApproachBound::waysOf(std::span<const std::uint32_t> nodes, std::span<const Vec3> to,
                                          std::span<const Vec3> from) {
  Ways ways;
  bool first = true;
  for (const std::uint32_t n : nodes) {
    const Vec3 way = from.empty() ? to[n] : to[n] - from[n];
    if (first) ways.low = ways.high = way;
    first = false;
    ways.low = {std::min(ways.low.x, way.x), std::min(ways.low.y, way.y), std::min(ways.low.z, way.z)};
    ways.high = {std::max(ways.high.x, way.x), std::max(ways.high.y, way.y), std::max(ways.high.z, way.z)};
    ways.most = std::max(ways.most, squaredLength(way));
  }
  ways.most = std::sqrt(ways.most);
  return ways;
}

double ApproachBound::parted(const Ways& a, const Ways& b) {
  const Vec3 most{std::max(a.high.x - b.low.x, b.high.x - a.low.x), std::max(a.high.y - b.low.y, b.high.y - a.low.y),
                  std::max(a.high.z - b.low.z, b.high.z - a.low.z)};
  return std::min(length(most), a.most + b.most);
}

double ApproachBound::excess(const Motion& motion, double listed, double reach) const {
  double farthest = 0, longest = 0;
  for (std::size_t k = 0; k < from_.size(); ++k) farthest = std::max(farthest, squaredLength(motion.x[k] - from_[k]));
  for (const Vec3 m : motion.move) longest = std::max(longest, squaredLength(m));
  const double most = std::sqrt(farthest) + motion.share * std::sqrt(longest), atOnce = 2 * most + reach - listed;
  if (atOnce <= 0) return atOnce;
  std::vector<Ways> gone(cells_.size()), ahead(motion.move.empty() ? 0 : cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto nodes = list_.nodes.of(cells_[c].number);
    gone[c] = waysOf(nodes, motion.x, from_);
    if (!ahead.empty()) ahead[c] = waysOf(nodes, motion.move, {});
  }
  // Cells n apart are (n - 1) sides away from each other at least.
  const auto range = static_cast<std::int64_t>(std::min((2 * most + reach) / list_.side, 1e3)) + 1;
  if (range > kFarthest) return atOnce;
  double worst = -std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto& at = cells_[c].at;
    const auto last = [&](int axis) { return std::min(list_.count[axis] - 1, at[axis] + range); };
    for (std::int64_t k = at[2]; k <= last(2); ++k)
      for (std::int64_t j = std::max<std::int64_t>(0, at[1] - range); j <= last(1); ++j)
        for (std::int64_t i = std::max<std::int64_t>(0, at[0] - range); i <= last(0); ++i) {
          const std::uint32_t other = index_[list_.number(i, j, k)];
          if (other == kNoNode || other < c) continue;
          const auto sidesAway = [&](std::int64_t to, int axis) {
            const double n = static_cast<double>(std::abs(to - at[axis])) - 1;
            return n > 0 ? n * n : 0;
          };
          const double away = list_.side * std::sqrt(sidesAway(i, 0) + sidesAway(j, 1) + sidesAway(k, 2));
          const double nearer =
              parted(gone[c], gone[other]) + (ahead.empty() ? 0 : motion.share * parted(ahead[c], ahead[other]));
          worst = std::max(worst, nearer + reach - std::max(listed, away));
        }
  }
  return worst;
}

}  // namespace karinui
