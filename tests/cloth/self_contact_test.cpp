// The push of cloth on cloth: how deep a layer is borne, and that folds which hang against each other come to rest.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

// What a layer weighs on each pair is at most all that its node carries, so it sinks no deeper than where that pair
// alone bears it, k h^2 radius (0.1 r^2 + 8 r^6) = w g h^2 with k = 3e5 N/m3: r = 0.15 of 2 mm for cotton, and not to
// where a stiff push would hold it.
TEST(SelfContact, ALayerIsBorneSoftly) {
  ClothLevel level;
  const Fabric cotton = *preset("cotton");
  const auto small = gridLattice(8, 8, 0.01), large = gridLattice(16, 16, 0.01, {-0.0413, -0.0387});
  addPiece(level.cloth, small, cotton);
  addPiece(level.cloth, large, cotton, false);
  level.state = standingBy(level.cloth, [](std::size_t piece, Flat p) {
    return Vec3{p.u, piece == 0 ? 0.0019 : 0.0, p.v};
  });
  std::vector<ClothLevel> levels{std::move(level)};
  Workers workers(1);
  const auto report = settle(levels, NoBody(), {}, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << report->why.pattern;
  double mean = 0;
  for (std::size_t k = 0; k < small->nodes.size(); ++k) mean += levels[0].state.position[k].y / small->nodes.size();
  EXPECT_GT(mean, 0.002 * (1 - 0.155));
  EXPECT_LT(mean, 0.00195);
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
  Workers workers(2);
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
