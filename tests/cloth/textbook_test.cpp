#include <gtest/gtest.h>

#include "cloth/helpers.h"

namespace karinui::test {
namespace {

constexpr double kGravity = 9.81;

struct Row {
  double gamma, fall, reach;  // w L^3/B, H/L, W/L
};

// The heavy elastica of a cantilever: finite differences of 8000 nodes, extrapolated.
class Cantilever : public testing::TestWithParam<Row> {};

TEST_P(Cantilever, HangsAsTheElasticaSays) {
  const Row row = GetParam();
  const double b = 5e-5, weight = 0.2;
  const std::uint32_t rows = row.gamma > 40 ? 40 : 24, columns = 4, clamped = 3;
  const double length = std::cbrt(row.gamma * b / (weight * kGravity)), h = length / rows;
  // On a bare lattice the clamp is exactly its last held row.
  ClothLevel level;
  addPiece(level.cloth, gridLattice(columns, rows + clamped, h), textbook(3000, b, weight));
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0, p.v}; });
  for (std::uint32_t k = 0; k < (clamped + 1) * (columns + 1); ++k) level.cloth.pinned.push_back(k);
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.stopMove = 1e-4 * length;
  settings.stopResidual = 0.1;
  settings.maxSteps = 3000;
  Workers workers(1);
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  ASSERT_TRUE(report) << text(report.error().what);
  const Vec3 end = levels[0].state.position[(rows + clamped) * (columns + 1) + columns / 2];
  const double free = length, held = clamped * h;
  EXPECT_NEAR(-end.y / free, row.fall, 0.03 * row.fall);
  // Nearly upright the reach is a small difference of the clamp's curve: 3 % of it, or 0.5 % of the strip.
  EXPECT_NEAR((end.z - held) / free, row.reach, std::fmax(0.03 * row.reach, 0.005));
}

INSTANTIATE_TEST_SUITE_P(Rows, Cantilever,
                         testing::Values(Row{0.1, .01250, .99991}, Row{1, .12347, .99125}, Row{2, .23851, .96689},
                                         Row{5, .49591, .84666}, Row{10, .70020, .65635}, Row{20, .82988, .44523},
                                         Row{50, .90792, .24502}, Row{100, .93752, .15922}, Row{300, .96501, .08629},
                                         Row{1000, .98114, .04599}));

TEST(HangingStrip, LengthensByWLSquaredOverTwoK) {
  const double k = 50, weight = 0.3, length = 0.5, h = 0.02;
  for (Flat grain : {Flat{0, 1}, Flat{1, 0}}) {
    ClothLevel level = levelOf(patternOf({rectangle(1, 0.1, length, grain)}), h, textbook(k, 1e-6, weight));
    const auto& nodes = level.cloth.pieces[0].lattice->nodes;
    std::uint32_t low = 0;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (nodes[n].v > length - 1e-9) level.cloth.pinned.push_back(n);
      if (nodes[n].v < 1e-9 && std::fabs(nodes[n].u - 0.05) < std::fabs(nodes[low].u - 0.05)) low = n;
    }
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-6;
    settings.stopResidual = 0.01;
    settings.maxSteps = 2000;
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    const double longer = -levels[0].state.position[low].y;
    EXPECT_NEAR(longer, weight * kGravity * length * length / (2 * k),
                0.01 * weight * kGravity * length * length / (2 * k));
  }
}

TEST(Simcloth, HasOneRestWhateverTheStart) {
  // Tension only and weight: convex, so every start ends at the same place.
  Fabric f = *preset("simcloth");
  f.stretchWarp = 50;
  std::vector<Vec3> first;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    ClothLevel level;
    addPiece(level.cloth, gridLattice(5, 5, 0.04), f);
    level.cloth.pinned = {30, 35};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-0.1, 0.1);
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      const bool pinned = p.v > 0.19 && (p.u < 0.01 || p.u > 0.19);
      return Vec3{p.u, p.v, 0} + (pinned ? Vec3{} : Vec3{by(random), by(random), 0});
    });
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-6;
    settings.stopResidual = 0.02;
    settings.maxSteps = 1500;
    settings.clothOnCloth = false;  // a heap of crossing cloth is no convex problem
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    if (first.empty()) first = levels[0].state.position;
    for (std::size_t k = 0; k < first.size(); ++k)
      EXPECT_LT(distance(first[k], levels[0].state.position[k]), 2e-5) << "seed " << seed << " node " << k;
  }
}

}  // namespace
}  // namespace karinui::test
