#include <gtest/gtest.h>

#include "cloth/helpers.h"

namespace karinui::test {
namespace {

constexpr double kGravity = 9.81;

// A strip of a rectangle laid as cloth, flat in the horizontal plane, held up to `clamp`.
ClothLevel strip(double length, double width, double clamp, double spacing, const Fabric& fabric, Flat grain = {0, 1}) {
  ClothLevel level = levelOf(patternOf({rectangle(1, width, length + clamp, grain)}), spacing, fabric);
  const auto& nodes = level.cloth.pieces[0].lattice->nodes;
  for (std::uint32_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].v <= clamp + 1e-9) level.cloth.pinned.push_back(k);
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0, p.v}; });
  return level;
}

struct Row {
  double gamma, fall, reach;  // w L^3/B, H/L, W/L
};

// The heavy elastica of a cantilever: finite differences of 8000 nodes, extrapolated.
class Cantilever : public testing::TestWithParam<Row> {};

TEST_P(Cantilever, HangsAsTheElasticaSays) {
  const Row row = GetParam();
  const double b = 5e-5, weight = 0.2, spacingsLong = 60;
  const double length = std::cbrt(row.gamma * b / (weight * kGravity));
  const double h = length / spacingsLong;
  const double clamp = 2.75 * h;  // between a row of the grid and the border's next node
  std::vector<ClothLevel> levels{strip(length, 6 * h, clamp, h, textbook(3000, b, weight))};
  // The clamp is where the last held row of the grid is.
  double held = 0, tip = 0;
  std::size_t tipNode = 0;
  const auto& nodes = levels[0].cloth.pieces[0].lattice->nodes;
  for (std::uint32_t k : levels[0].cloth.pinned) held = std::fmax(held, nodes[k].v);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].v > tip + 1e-9 ||
        (nodes[k].v > tip - 1e-9 && std::fabs(nodes[k].u - 3 * h) < std::fabs(nodes[tipNode].u - 3 * h))) {
      tip = std::fmax(tip, nodes[k].v);
      tipNode = k;
    }
  SettleSettings settings;
  settings.stopMove = 2e-5 * length;
  settings.stopResidual = 0.1;
  settings.maxSteps = 3000;
  Workers workers(1);
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  ASSERT_TRUE(report) << text(report.error().what);
  EXPECT_TRUE(report->settled) << text(report->why);
  const Vec3 end = levels[0].state.position[tipNode];
  const double free = length + clamp - held;
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
