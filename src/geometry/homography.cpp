#include "karinui/geometry/homography.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

bool threeOnALine(const std::array<Flat, 4>& places) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Flat a = places[(i + 1) % 4] - places[i], b = places[(i + 2) % 4] - places[i];
    if (!(std::fabs(cross(a, b)) > 1e-9 * length(a) * length(b))) return true;
  }
  return false;
}

}  // namespace

std::optional<Homography> Homography::through(const std::array<Flat, 4>& from, const std::array<Flat, 4>& to) {
  if (threeOnALine(from) || threeOnALine(to)) return std::nullopt;
  // Two rows a place, of the eight numbers and the right side.
  std::array<std::array<double, 9>, 8> rows{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [x, y] = from[i];
    const auto [u, v] = to[i];
    rows[2 * i] = {x, y, 1, 0, 0, 0, -u * x, -u * y, u};
    rows[2 * i + 1] = {0, 0, 0, x, y, 1, -v * x, -v * y, v};
  }
  // Gauss's elimination, the largest number of a column first.
  for (std::size_t k = 0; k < 8; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 8; ++i)
      if (std::fabs(rows[i][k]) > std::fabs(rows[best][k])) best = i;
    std::swap(rows[k], rows[best]);
    for (std::size_t i = 0; i < 8; ++i) {
      if (i == k) continue;
      const double times = rows[i][k] / rows[k][k];
      for (std::size_t c = k; c < 9; ++c) rows[i][c] -= times * rows[k][c];
    }
  }
  Homography map;
  for (std::size_t k = 0; k < 8; ++k) {
    map.h_[k] = rows[k][8] / rows[k][k];
    if (!std::isfinite(map.h_[k])) return std::nullopt;
  }
  return map;
}

Flat Homography::operator()(Flat p) const {
  const double d = depth(p);
  return {(h_[0] * p.u + h_[1] * p.v + h_[2]) / d, (h_[3] * p.u + h_[4] * p.v + h_[5]) / d};
}

bool convex(const std::array<Flat, 4>& corners) {
  int left = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Flat a = corners[(i + 1) % 4] - corners[i], b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    const double turn = cross(a, b);
    if (std::fabs(turn) < 1e-3 * length(a) * length(b)) return false;
    left += turn > 0 ? 1 : -1;
  }
  return left == 4 || left == -4;
}

}  // namespace karinui
