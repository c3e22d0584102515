#include "karinui/geometry/homography.h"

#include <gtest/gtest.h>

#include <random>

namespace karinui {
namespace {

TEST(Homography, TakesFourPlacesToFourAndStraightLinesToStraightLines) {
  std::mt19937 lot(3);
  std::uniform_real_distribution<double> by(-0.2, 0.2), in(0, 1);
  for (int k = 0; k < 200; ++k) {
    std::array<Flat, 4> from{Flat{0, 0}, {3000, 0}, {3000, 2000}, {0, 2000}}, to{Flat{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (Flat& p : to) p += Flat{by(lot), by(lot)};
    const auto there = Homography::through(from, to), back = Homography::through(to, from);
    ASSERT_TRUE(there && back);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance((*there)(from[i]), to[i]), 1e-9);
    const Flat a{3000 * in(lot), 2000 * in(lot)}, b{3000 * in(lot), 2000 * in(lot)};
    EXPECT_LT(distance((*back)((*there)(a)), a), 1e-5);
    const Flat p = (*there)(a), q = (*there)(b), m = (*there)(lerp(a, b, 0.3));
    EXPECT_NEAR(cross(q - p, m - p), 0, 1e-9);
  }
}

TEST(Homography, ThereIsNoneWhereThreePlacesLieOnALine) {
  const std::array<Flat, 4> square{Flat{0, 0}, {1, 0}, {1, 1}, {0, 1}}, flat{Flat{0, 0}, {1, 0}, {2, 0}, {0, 1}};
  EXPECT_FALSE(Homography::through(flat, square));
  // Nor where rounding leaves a trace of one.
  std::mt19937 lot(5);
  std::uniform_real_distribution<double> at(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Flat p{at(lot), at(lot)}, along{at(lot), at(lot)}, aside{at(lot), at(lot)};
    if (std::fabs(cross(along, aside)) < 0.05) continue;
    EXPECT_FALSE(Homography::through({p, p + along * (1.0 / 3), p + along, p + aside}, square)) << k;
  }
  EXPECT_TRUE(convex(square));
  EXPECT_FALSE(convex({square[0], square[1], Flat{0.2, 0.2}, square[3]})) << "dented";
  EXPECT_FALSE(convex(flat));
  EXPECT_FALSE(convex({square[0], square[2], square[1], square[3]}));
}

}  // namespace
}  // namespace karinui
