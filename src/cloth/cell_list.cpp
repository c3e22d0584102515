#include "cloth/cell_list.h"

#include <cmath>

namespace karinui {
namespace {

constexpr std::size_t kMostCells = 400'000;

}  // namespace

CellList::CellList(std::span<const Vec3> x, double asked) : low(x.front()), side(asked) {
  Vec3 high = low;
  for (Vec3 p : x) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
  for (;; side *= 1.3) {
    const auto last = at(high);
    count = {last[0] + 1, last[1] + 1, last[2] + 1};
    const double cells = static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]);
    if (cells <= static_cast<double>(kMostCells)) break;
  }
  std::vector<KeyValue> items;
  items.reserve(x.size());
  for (std::uint32_t n = 0; n < x.size(); ++n) {
    const auto c = at(x[n]);
    items.emplace_back(static_cast<std::uint32_t>(number(c[0], c[1], c[2])), n);
  }
  nodes = incidenceOf(static_cast<std::size_t>(count[0] * count[1] * count[2]), items);
  place.reserve(x.size());
  for (const std::uint32_t n : nodes.item) place.push_back(x[n]);
}

}  // namespace karinui
