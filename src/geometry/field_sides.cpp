#include "geometry/field_sides.h"

namespace karinui {

// Between two grid points whose distances sum to more than their spacing the surface cannot pass, so both lie on the
// same side. One winding number therefore settles a whole region.
std::vector<std::int8_t> sidesOf(const SpacedGrid& grid, const Count& first, const Count& count,
                                 const std::vector<float>& distance, const Bvh& bvh) {
  constexpr std::int8_t kNotKnown = 0;
  const std::size_t nx = count[0], nxy = nx * count[1];
  std::vector<std::int8_t> sides(distance.size(), kNotKnown);
  std::vector<std::size_t> pending;
  for (std::size_t seed = 0; seed < sides.size(); ++seed) {
    if (sides[seed] != kNotKnown) continue;
    const Vec3 place = grid.place(first[0] + seed % nx, first[1] + seed / nx % count[1], first[2] + seed / nxy);
    sides[seed] = bvh.windingNumber(place) > 0.5 ? -1 : 1;
    pending.push_back(seed);
    while (!pending.empty()) {
      const std::size_t n = pending.back();
      pending.pop_back();
      const auto pass = [&](bool there, std::size_t next) {
        if (!there || sides[next] != kNotKnown) return;
        if (distance[n] + distance[next] <= grid.step * (1 + 1e-5)) return;
        sides[next] = sides[n];
        pending.push_back(next);
      };
      const std::size_t i = n % nx, j = n / nx % count[1], k = n / nxy;
      pass(i > 0, n - 1);
      pass(i + 1 < nx, n + 1);
      pass(j > 0, n - nx);
      pass(j + 1 < count[1], n + nx);
      pass(k > 0, n - nxy);
      pass(k + 1 < count[2], n + nxy);
    }
  }
  return sides;
}

}  // namespace karinui
