#include <algorithm>
#include <cmath>
#include <limits>

#include "karinui/pattern/lattice.h"

namespace karinui {
namespace {

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  std::array<double, 3> weight{};
};

// The nearest place of a triangle, as weights.
Nearest nearestOn(Flat a, Flat b, Flat c, Flat p) {
  const double area = cross(b - a, c - a);
  if (area > 0) {
    const double wa = cross(b - p, c - p) / area, wb = cross(c - p, a - p) / area;
    if (wa >= 0 && wb >= 0 && wa + wb <= 1) return {0, {wa, wb, 1 - wa - wb}};
  }
  Nearest best;
  const std::array<Flat, 3> corner{a, b, c};
  for (int k = 0; k < 3; ++k) {
    const Flat from = corner[k], along = corner[(k + 1) % 3] - from;
    const double squared = dot(along, along);
    const double t = squared > 0 ? std::clamp(dot(p - from, along) / squared, 0.0, 1.0) : 0;
    const Flat away = p - (from + along * t);
    if (dot(away, away) >= best.squared) continue;
    best = {dot(away, away), {}};
    best.weight[k] = 1 - t;
    best.weight[(k + 1) % 3] = t;
  }
  return best;
}

}  // namespace

LatticeFinder::LatticeFinder(const std::vector<Flat>& nodes, const std::vector<Triangle>& faces)
    : nodes_(nodes), faces_(faces) {
  KARINUI_ASSERT(!faces_.empty());
  Flat high{-HUGE_VAL, -HUGE_VAL};
  low_ = {HUGE_VAL, HUGE_VAL};
  for (const Triangle& f : faces_)
    for (std::uint32_t n : f) {
      low_ = {std::min(low_.u, nodes_[n].u), std::min(low_.v, nodes_[n].v)};
      high = {std::max(high.u, nodes_[n].u), std::max(high.v, nodes_[n].v)};
    }
  // About two faces to a cell.
  const double width = std::max(high.u - low_.u, 1e-9), height = std::max(high.v - low_.v, 1e-9);
  cell_ = std::max({std::sqrt(2 * width * height / static_cast<double>(faces_.size())), width / 4000, height / 4000});
  columns_ = static_cast<std::uint32_t>(width / cell_) + 1;
  rows_ = static_cast<std::uint32_t>(height / cell_) + 1;
  const auto cells = [&](const Triangle& f, auto&& visit) {
    Flat a = nodes_[f[0]], b = a;
    for (std::uint32_t n : f) {
      a = {std::min(a.u, nodes_[n].u), std::min(a.v, nodes_[n].v)};
      b = {std::max(b.u, nodes_[n].u), std::max(b.v, nodes_[n].v)};
    }
    const auto at = [&](double x, std::uint32_t count) {
      return std::min(static_cast<std::uint32_t>(std::max(x, 0.0) / cell_), count - 1);
    };
    const std::uint32_t i0 = at(a.u - low_.u, columns_), i1 = at(b.u - low_.u, columns_);
    const std::uint32_t j0 = at(a.v - low_.v, rows_), j1 = at(b.v - low_.v, rows_);
    for (std::uint32_t j = j0; j <= j1; ++j)
      for (std::uint32_t i = i0; i <= i1; ++i) visit(j * columns_ + i);
  };
  start_.assign(std::size_t{columns_} * rows_ + 1, 0);
  for (const Triangle& f : faces_) cells(f, [&](std::uint32_t c) { ++start_[c + 1]; });
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  item_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::uint32_t f = 0; f < faces_.size(); ++f) cells(faces_[f], [&](std::uint32_t c) { item_[next[c]++] = f; });
}

LatticePlace LatticeFinder::find(Flat place) const {
  const auto index = [&](double x, std::uint32_t count) {
    return static_cast<int>(std::clamp(std::floor(x / cell_), 0.0, static_cast<double>(count - 1)));
  };
  const int i0 = index(place.u - low_.u, columns_), j0 = index(place.v - low_.v, rows_);
  Nearest best;
  std::uint32_t bestFace = 0;
  const int furthest = static_cast<int>(std::max(columns_, rows_));
  for (int ring = 0; ring <= furthest; ++ring) {
    for (int j = j0 - ring; j <= j0 + ring; ++j) {
      if (j < 0 || j >= static_cast<int>(rows_)) continue;
      const bool fullRow = j == j0 - ring || j == j0 + ring;
      for (int i = i0 - ring; i <= i0 + ring; i += fullRow || ring == 0 ? 1 : 2 * ring) {
        if (i < 0 || i >= static_cast<int>(columns_)) continue;
        const std::size_t c = static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
        for (std::uint32_t k = start_[c]; k < start_[c + 1]; ++k) {
          const Triangle& f = faces_[item_[k]];
          const Nearest here = nearestOn(nodes_[f[0]], nodes_[f[1]], nodes_[f[2]], place);
          if (here.squared < best.squared || (here.squared == best.squared && item_[k] < bestFace)) {
            best = here;
            bestFace = item_[k];
          }
        }
      }
    }
    // What lies in a further ring of cells is at least this far away.
    const double u = place.u - low_.u, v = place.v - low_.v;
    const double clear = std::min(
        {u - (i0 - ring) * cell_, (i0 + ring + 1) * cell_ - u, v - (j0 - ring) * cell_, (j0 + ring + 1) * cell_ - v});
    if (clear > 0 && best.squared <= clear * clear) break;
  }
  return {faces_[bestFace], best.weight};
}

LatticePlace LatticeFinder::find(Flat place, Flat inwards) const {
  constexpr double kOffLine = 1e-5;  // metres: off the slit's line, still within the same triangle
  LatticePlace found = find(place + normalized(inwards - place) * kOffLine);
  for (int k = 0; k < 3; ++k) {
    if (nodes_[found.face[k]] != place) continue;
    found.weight = {};
    found.weight[k] = 1;  // a node of the mesh gets itself, to the bit
    return found;
  }
  found.weight = nearestOn(nodes_[found.face[0]], nodes_[found.face[1]], nodes_[found.face[2]], place).weight;
  return found;
}

std::vector<Flat> inwardsOf(const std::vector<Flat>& nodes, const std::vector<Triangle>& faces) {
  std::vector<Flat> sum(nodes.size());
  std::vector<double> count(nodes.size(), 0);
  for (const Triangle& f : faces) {
    const Flat middle = (nodes[f[0]] + nodes[f[1]] + nodes[f[2]]) * (1.0 / 3);
    for (const std::uint32_t n : f) {
      sum[n] += middle;
      count[n] += 1;
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] = count[n] > 0 ? sum[n] * (1 / count[n]) : nodes[n];
  return sum;
}

}  // namespace karinui
