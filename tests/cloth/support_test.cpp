// What resting cloth presses with, against what a scale and a belt would say.
#include "karinui/cloth/support.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cloth/helpers.h"

namespace karinui {
namespace {

using namespace test;

TEST(Support, ASheetOnATablePressesWithItsWeight) {
  Workers workers(1);
  const Token token;
  std::vector<ClothLevel> levels(1);
  addPiece(levels[0].cloth, gridLattice(20, 20, 0.02), textbook(1000, 1e-5, 0.25));
  levels[0].state = standingBy(levels[0].cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0.004, p.v}; });
  const PlaneBody table({0, 1, 0}, 0);
  const auto report = settle(levels, table, {}, token, workers);
  ASSERT_TRUE(report && report->settled);
  const auto support = supportOf(levels[0].cloth, levels[0].state, {0, -9.81, 0}, workers);
  const auto area = areasOf(levels[0].cloth);
  double sum = 0, all = 0;
  for (std::size_t k = 0; k < support.size(); ++k) sum += support[k].y * area[k], all += area[k];
  EXPECT_NEAR(all, 0.16, 1e-9);
  EXPECT_NEAR(sum / all, 0.25 * 9.81, 0.02);
}

TEST(Support, ATautBeltPressesWithItsTensionOverItsRadius) {
  // 4 % too small for a cylinder of 10 cm: 1000 N/m x 0.04 / 0.1 m = 400 Pa.
  constexpr double kRadius = 0.1, kStrain = 0.04;
  Workers workers(1);
  Cloth cloth;
  const double around = 2 * std::numbers::pi * kRadius, rest = around / (1 + kStrain);
  addPiece(cloth, gridLattice(120, 8, rest / 120), textbook(1000, 1e-7, 0.0001));
  const ClothState state = standingBy(cloth, [&](std::size_t, Flat p) {
    const double a = p.u / rest * 2 * std::numbers::pi;
    return Vec3{kRadius * std::sin(a), p.v, kRadius * std::cos(a)};
  });
  const auto support = supportOf(cloth, state, {}, workers);
  double worst = 0, askew = 0;
  for (std::size_t k = 0; k < support.size(); ++k) {
    const std::size_t column = k % 121, row = k / 121;
    if (column < 5 || column > 115 || row < 2 || row > 6) continue;
    const Vec3 out = normalized(Vec3{state.position[k].x, 0, state.position[k].z});
    // Per area of the cloth as it was cut, which lies 4 % wider now.
    worst = std::fmax(worst, std::fabs(dot(support[k], out) - 400 * (1 + kStrain)));
    askew = std::fmax(askew, length(support[k] - out * dot(support[k], out)));
  }
  EXPECT_LT(worst, 3);
  EXPECT_LT(askew, 3);
}

// Six times what the penalty of contact bears at the surface: a multiplier bears the rest, and the cloth is at rest
// there.
TEST(Support, ABeltThatIsFarTooSmallIsInBalanceOnTheSurface) {
  constexpr double kRadius = 0.1, kStrain = 0.06, kStiffness = 20000;
  constexpr std::uint32_t kColumns = 60, kRows = 12;
  Workers workers(1);
  const Token token;
  std::vector<ClothLevel> levels(1);
  Cloth& cloth = levels[0].cloth;
  const double rest = 2 * std::numbers::pi * kRadius / (1 + kStrain);
  addPiece(cloth, gridLattice(kColumns, kRows, rest / kColumns), textbook(kStiffness, 1e-5, 0.1));
  for (std::uint32_t j = 0; j <= kRows; ++j)
    cloth.ties.push_back({j * (kColumns + 1), j * (kColumns + 1) + kColumns, kNoNode, 0});
  levels[0].state = standingBy(cloth, [&](std::size_t, Flat p) {
    const double a = p.u / rest * 2 * std::numbers::pi;
    return Vec3{(kRadius + 0.002) * std::sin(a), p.v, (kRadius + 0.002) * std::cos(a)};
  });
  const CapsuleBody limb({{{0, -1, 0}, {0, 1, 0}, kRadius}});
  const auto report = settle(levels, limb, {}, token, workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << text(report->why) << " " << report->residual;
  for (const Vec3 p : levels[0].state.position) EXPECT_NEAR(std::hypot(p.x, p.z), kRadius, 0.0006);
  const auto support = supportOf(cloth, levels[0].state, {}, workers);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < support.size(); ++k) {
    const std::size_t column = k % (kColumns + 1), row = k / (kColumns + 1);
    if (column < 5 || column > kColumns - 5 || row < 3 || row > kRows - 3) continue;
    sum += dot(support[k], normalized(Vec3{levels[0].state.position[k].x, 0, levels[0].state.position[k].z}));
    ++count;
  }
  const double pressure = kStiffness * kStrain / kRadius * (1 + kStrain);
  EXPECT_NEAR(sum / count, pressure, 0.08 * pressure);
}

}  // namespace
}  // namespace karinui
