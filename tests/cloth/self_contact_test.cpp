// The push of cloth on cloth: how deep a layer is borne, and that folds which hang against each other come to rest.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/level_solver.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

// Sheets of one fabric that lie on a sheet which does not move, six with it: the mean height of each, metres.
std::vector<double> stackOf(const Fabric& fabric) {
  ClothLevel level;
  const auto small = gridLattice(8, 8, 0.01), large = gridLattice(16, 16, 0.01, {-0.0413, -0.0387});
  addPiece(level.cloth, large, fabric, false);
  for (int k = 1; k < 6; ++k) addPiece(level.cloth, small, fabric);
  level.state = standingBy(level.cloth, [](std::size_t piece, Flat p) {
    const double aside = 0.0007 * static_cast<double>(piece);  // no node lies over another
    return Vec3{p.u + aside, 0.0019 * static_cast<double>(piece), p.v + 2 * aside};
  });
  std::vector<ClothLevel> levels{std::move(level)};
  Workers workers(1);
  const auto report = settle(levels, NoBody(), {}, Token(), workers);
  EXPECT_TRUE(report && report->settled);
  std::vector<double> heights;
  for (const ClothPiece& piece : levels[0].cloth.pieces) {
    double mean = 0;
    for (std::size_t k = 0; k < piece.lattice->nodes.size(); ++k)
      mean += levels[0].state.position[piece.firstNode + k].y / static_cast<double>(piece.lattice->nodes.size());
    heights.push_back(mean);
  }
  return heights;
}

// What a layer weighs on each pair is at most all that its node carries, so it sinks no deeper than where that pair
// alone bears it, k h^2 radius (0.1 r^2 + 8 r^6) = n w g h^2 with k = 3e5 N/m3 and n layers: r is at most 0.15 for one
// of cotton, whose radius is 2 mm, and not where a stiff push would hold it.
TEST(SelfContact, LayersAreBorneSoftly) {
  const Fabric cotton = *preset("cotton");
  const std::vector<double> height = stackOf(cotton);
  constexpr double kRadius = 0.002;
  for (std::size_t k = 1; k < 6; ++k) {
    const double load = static_cast<double>(6 - k) * cotton.weight * 9.81 / (3e5 * kRadius);
    double r = 0;
    while (0.1 * r * r + 8 * std::pow(r, 6) < load) r += 1e-3;
    EXPECT_GT(height[k] - height[k - 1], kRadius * (1 - r) - 2e-5) << k;
    EXPECT_LT(height[k] - height[k - 1], 0.98 * kRadius) << k;
  }
}

// Six layers of a thick cloth are as thick as six times the cloth.
TEST(SelfContact, SixLayersAreSixTimesAsThick) {
  Fabric quilt = *preset("wool coating");
  quilt.thickness = 0.0025;
  const std::vector<double> height = stackOf(quilt);
  EXPECT_NEAR(height[5] - height[0] + quilt.thickness, 6 * quilt.thickness, 0.4 * quilt.thickness);
}

// On coarse cells, which ask for more room than layers have, they are together no thicker than three.
TEST(SelfContact, ManyLayersAreTogetherAsThickAsThreeOnCoarseCells) {
  for (const int layers : {1, 2, 3, 4, 6, 20}) {
    Cloth cloth;
    for (int k = 0; k < layers; ++k) {
      addPiece(cloth, gridLattice(2, 2, 0.06), *preset("cotton"));
      addPiece(cloth, gridLattice(2, 2, 0.06), *preset("cotton"));
      cloth.pieces[cloth.pieces.size() - 2].layer = cloth.pieces.back().layer = k;
    }
    cloth.spacing = 0.06;
    EXPECT_NEAR(layers * clothRadius(cloth, 0.015), std::min(layers, 3) * 0.3 * 0.06, 1e-12) << layers;
    EXPECT_NEAR(clothRadius(cloth, 0.06), 0.002, 1e-12) << layers;
  }
}

// A curtain of silk, drawn together to a quarter, whose folds press against each other.
TEST(SelfContact, FoldsThatHangAgainstEachOtherComeToRest) {
  constexpr double kCell = 0.02, kDrawn = 0.2;
  constexpr std::uint32_t kColumns = 64, kRows = 24;
  ClothLevel level;
  addPiece(level.cloth, gridLattice(kColumns, kRows, kCell), *preset("silk"));
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) {
    const double fold = 8 * kCell, deep = fold * std::sqrt(1 - kDrawn * kDrawn);
    const double in = std::fmod(p.u + 1e-9, fold) / fold;
    return Vec3{kDrawn * p.u, p.v, deep * (in < 0.5 ? in : 1 - in)};
  });
  for (std::uint32_t i = 0; i <= kColumns; i += 4) level.cloth.pinned.push_back(kRows * (kColumns + 1) + i);
  std::vector<ClothLevel> levels{std::move(level)};
  Workers workers(1);
  SettleSettings settings;
  settings.maxSteps = 150;  // a stiff push takes 216
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << report->why.pattern;
  const ClothCheck stands = check(levels[0].cloth, levels[0].state, nullptr);
  EXPECT_EQ(stands.clothClothCrossings, 0u);
  EXPECT_EQ(stands.foldCrossings, 0u);
}

}  // namespace
}  // namespace karinui::test
