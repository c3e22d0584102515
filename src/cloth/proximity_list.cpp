#include "cloth/proximity_list.h"
#include "cloth/work_blocks.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kMargin = 0.7;           // spacings by which the list is wider than asked
constexpr double kOpenSeamCosine = -0.9;  // a seam folded by less is not asked whether its sheets touch
constexpr std::size_t kMostCells = 400'000;

// Nodes sorted into the cells of a box around the cloth.
struct CellGrid {
  Vec3 low;
  double cell = 1;
  std::array<std::int64_t, 3> count{};
  Incidence nodes;          // of each cell
  std::vector<Vec3> place;  // of each item of `nodes`

  std::array<std::int64_t, 3> at(Vec3 p) const {
    return {static_cast<std::int64_t>((p.x - low.x) / cell), static_cast<std::int64_t>((p.y - low.y) / cell),
            static_cast<std::int64_t>((p.z - low.z) / cell)};
  }
  std::size_t number(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * count[1] + j) * count[0] + i);
  }
  CellGrid(std::span<const Vec3> x, double reach) : low(x.front()), cell(reach) {
    Vec3 high = low;
    for (Vec3 p : x) {
      low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
      high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    for (;; cell *= 1.3) {
      const auto last = at(high);
      count = {last[0] + 1, last[1] + 1, last[2] + 1};
      const double cells =
          static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]);
      if (cells <= static_cast<double>(kMostCells)) break;
    }
    std::vector<KeyValue> items;
    items.reserve(x.size());
    for (std::uint32_t n = 0; n < x.size(); ++n) {
      const auto c = at(x[n]);
      items.emplace_back(static_cast<std::uint32_t>(number(c[0], c[1], c[2])), n);
    }
    nodes = incidenceOf(static_cast<std::size_t>(count[0] * count[1] * count[2]), items);
    for (const std::uint32_t n : nodes.item) place.push_back(x[n]);
  }
};

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

bool ProximityList::covers(std::span<const Vec3> x, double reach) const {
  if (madeAt_.size() != x.size()) return false;
  double moved = 0;
  for (std::size_t k = 0; k < x.size(); ++k) moved = std::fmax(moved, squaredLength(x[k] - madeAt_[k]));
  return reach + 2 * std::sqrt(moved) <= reach_;
}

void ProximityList::make(std::span<const Vec3> x, double reach, Workers& workers) {
  reach_ = reach + kMargin * spacing_;
  madeAt_.assign(x.begin(), x.end());
  const CellGrid grid(x, reach_);
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
