#include "cloth/proximity_list.h"
#include "cloth/work_blocks.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kMargin = 0.7;           // spacings by which the list is wider than asked
constexpr double kOpenSeamCosine = -0.9;  // a seam folded by less is not asked whether its sheets touch
constexpr double kBoundCell = 2;          // reaches: side of the cells in which approach is bounded
constexpr int kWidenings = 4;             // of the list, until it serves the motion with half of the margin left

}  // namespace

// The cosine between the sheets at two nodes beside each other over a seam: -1 where they lie open.
double ProximityList::seamCosine(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const {
  const auto into = [&](NodeIndex k, NodeIndex other) {  // from the seam into the sheet
    if (sewn_.groupOf[k] == kNoNode) return x[k] - x[other];
    Vec3 sum;
    for (const std::uint32_t f : topology_.facesOf.of(k))
      for (const NodeIndex c : topology_.faces[f]) sum += x[c] - x[k];
    return sum;
  };
  return dot(normalized(into(a, b)), normalized(into(b, a)));
}

bool ProximityList::openSeam(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const {
  return topology_.overSeam(a, b) && seamCosine(a, b, x) < kOpenSeamCosine;
}

bool ProximityList::covers(const ApproachBound::Motion& motion, double reach) const {
  return madeAt_.size() == motion.x.size() && bound_.excess(motion, reach_, reach) <= 0;
}

void ProximityList::make(const ApproachBound::Motion& motion, double reach, Workers& workers) {
  madeAt_.assign(motion.x.begin(), motion.x.end());
  const double margin = kMargin * spacing_;
  reach_ = reach + margin;
  for (int k = 0; k < kWidenings; ++k) {
    bound_.make(motion.x, kBoundCell * reach_);
    const double excess = bound_.excess(motion, reach_, reach);
    if (excess <= -0.5 * margin) break;
    reach_ += excess + margin;
  }
  list(motion.x, workers);
}

void ProximityList::list(std::span<const Vec3> x, Workers& workers) {
  const CellList grid(x, reach_);
  std::vector<std::vector<std::array<NodeIndex, 2>>> found((x.size() + kPairBlock - 1) / kPairBlock);
  workers.forBlocks(x.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = found[begin / kPairBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto a = static_cast<NodeIndex>(n);
      const Vec3 p = x[a];
      const auto c = grid.at(p);
      for (std::int64_t k = std::max<std::int64_t>(0, c[2] - 1); k <= std::min(grid.count[2] - 1, c[2] + 1); ++k)
        for (std::int64_t j = std::max<std::int64_t>(0, c[1] - 1); j <= std::min(grid.count[1] - 1, c[1] + 1); ++j) {
          // Cells beside each other along x lie beside each other in memory.
          const std::size_t from = grid.number(std::max<std::int64_t>(0, c[0] - 1), j, k);
          const std::size_t to = grid.number(std::min(grid.count[0] - 1, c[0] + 1), j, k);
          for (std::uint32_t i = grid.nodes.start[from]; i < grid.nodes.start[to + 1]; ++i) {
            const NodeIndex b = grid.nodes.item[i];
            if (b <= a || (!topology_.live[a] && !topology_.live[b])) continue;
            if (onlyLayers_ && topology_.piece[a] != topology_.piece[b] && topology_.layer[a] == topology_.layer[b])
              continue;
            if (squaredLength(grid.place[i] - p) > reach_ * reach_ || topology_.neighbours(a, b)) continue;
            if (!openSeam(a, b, x)) out.push_back({a, b});
          }
        }
    }
  });
  pairs_.clear();
  for (const auto& block : found) pairs_.insert(pairs_.end(), block.begin(), block.end());
}

}  // namespace karinui
