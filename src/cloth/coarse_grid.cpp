#include "cloth/coarse_grid.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {

CoarseLines::CoarseLines(std::uint32_t fine, double about) {
  const std::uint32_t last = std::max(2u, fine) - 1, middle = static_cast<std::uint32_t>(std::lround(about));
  const auto beyond = [&](std::uint32_t lines) { return (lines - last % lines) % lines; };
  each = middle;
  for (const std::uint32_t lines : {middle - 1, middle + 1})
    if (beyond(lines) < beyond(each)) each = lines;
  for (std::uint32_t k = 0; k < last; k += each) at.push_back(k);
  at.push_back(last);
  for (std::uint32_t i = 0; i < fine; ++i) {
    const auto [in, weights] = place(i);
    cell.push_back(in);
    const auto b = static_cast<float>(weights[1]), c = static_cast<float>(weights[2]);
    weight[0].push_back(1 - b - c);  // so that they add up to one in float, too
    weight[1].push_back(b);
    weight[2].push_back(c);
  }
  for (auto& weights : weight) weights.resize(weights.size() + kLanes, 0);
}

std::pair<std::uint32_t, CoarseLines::Weights> CoarseLines::place(double fine) const {
  const double cells = fine / each, last = static_cast<double>(at.size() - 2);
  const auto in = static_cast<std::uint32_t>(std::clamp(std::floor(cells), 0.0, last));
  const double t = std::clamp(cells - in, 0.0, 1.0);
  return {in, {0.5 * (1 - t) * (1 - t), 0.5 + t - t * t, 0.5 * t * t}};
}

CoarseStencil stencilAt(const CoarseGrid& grid, double column, double row) {
  const auto [i, across] = grid.column.place(column);
  const auto [j, along] = grid.row.place(row);
  CoarseStencil stencil;
  for (std::uint32_t v = 0; v < 3; ++v)
    for (std::uint32_t u = 0; u < 3; ++u)
      stencil[3 * v + u] = {grid.first + (j + v) * grid.columns() + i + u, static_cast<float>(across[u] * along[v])};
  return stencil;
}

}  // namespace karinui
