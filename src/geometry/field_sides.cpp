#include "geometry/field_sides.h"

namespace karinui {
namespace {

constexpr std::int8_t kUnknown = 0;

// Between two grid points whose distances sum to more than their spacing the surface cannot pass, so both lie on the
// same side. One winding number therefore settles a whole region.
class SideFinder {
 public:
  SideFinder(const SpacedGrid& grid, const std::vector<float>& distance, const Bvh& bvh)
      : grid_(grid), distance_(distance), bvh_(bvh), sides_(distance.size(), kUnknown) {}

  std::vector<std::int8_t> find(const Token& token) {
    std::size_t n = 0;
    for (std::size_t k = 0; k < grid_.count[2]; ++k) {
      if (token.cancelled()) break;
      for (std::size_t j = 0; j < grid_.count[1]; ++j)
        for (std::size_t i = 0; i < grid_.count[0]; ++i, ++n) {
          if (sides_[n] != kUnknown) continue;
          sides_[n] = bvh_.windingNumber(grid_.place(i, j, k)) > 0.5 ? -1 : 1;
          spread(n);
        }
    }
    return std::move(sides_);
  }

 private:
  void spread(std::size_t seed) {
    const std::size_t nx = grid_.count[0], nxy = nx * grid_.count[1];
    std::vector<std::size_t> pending{seed};
    while (!pending.empty()) {
      const std::size_t n = pending.back();
      pending.pop_back();
      const auto pass = [&](bool there, std::size_t next) {
        if (!there || sides_[next] != kUnknown) return;
        if (distance_[n] + distance_[next] <= grid_.step * (1 + 1e-5)) return;
        sides_[next] = sides_[n];
        pending.push_back(next);
      };
      const std::size_t i = n % nx, j = n / nx % grid_.count[1], k = n / nxy;
      pass(i > 0, n - 1);
      pass(i + 1 < nx, n + 1);
      pass(j > 0, n - nx);
      pass(j + 1 < grid_.count[1], n + nx);
      pass(k > 0, n - nxy);
      pass(k + 1 < grid_.count[2], n + nxy);
    }
  }

  const SpacedGrid& grid_;
  const std::vector<float>& distance_;
  const Bvh& bvh_;
  std::vector<std::int8_t> sides_;
};

}  // namespace

std::vector<std::int8_t> sidesOf(const SpacedGrid& grid, const std::vector<float>& distance, const Bvh& bvh,
                                 const Token& token) {
  return SideFinder(grid, distance, bvh).find(token);
}

}  // namespace karinui
