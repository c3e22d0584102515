// The heavy elastica of a cantilever on strips as lay() makes them, border ring and all.
#include <gtest/gtest.h>

#include "cloth/helpers.h"

namespace karinui::test {
namespace {

struct Row {
  double gamma, fall, reach;  // w L^3/B, H/L, W/L
  int rows = 24;              // of the free strip; the stiffer the bend at the clamp, the finer
};

class LaidCantilever : public testing::TestWithParam<std::tuple<Row, int>> {};

TEST_P(LaidCantilever, HangsAsTheElasticaSays) {
  const auto [row, degrees] = GetParam();
  const double bend = 5e-5, weight = 0.2, around = std::cbrt(row.gamma * bend / (weight * 9.81)), h = around / row.rows;
  const double width = 4 * h, clamped = 3 * h, height = around + clamped;
  const double turn = degrees * std::acos(-1.0) / 180;
  const Flat grain{std::sin(turn), std::cos(turn)};
  // The clamp's line: a row of the grid some spacings in, with a notch on both sides so that the border has nodes on
  // it.
  auto piece = rectangle(1, width, height, grain);
  double line = 0;
  {
    const auto laid = lay(patternOf({piece}), h);
    ASSERT_TRUE(laid);
    double best = 1;
    const Lattice& lattice = *laid->lattices.begin()->second;
    for (std::uint32_t k : lattice.grid)
      if (k != kNoNode && std::fabs(lattice.nodes[k].v - clamped) < best) {
        best = std::fabs(lattice.nodes[k].v - clamped);
        line = lattice.nodes[k].v;
      }
  }
  piece->marks = {{"left", "left", 1 - line / height, {}}, {"right", "right", line / height, {}}};
  const double free = height - line;
  const double stiff = weight * 9.81 * free * free * free / row.gamma;  // the clamp takes what the grid offers
  ClothLevel level = levelOf(patternOf({piece}), h, textbook(3000, stiff, weight));
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0, p.v}; });
  const auto& nodes = level.cloth.pieces[0].lattice->nodes;
  std::uint32_t tip = 0;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].v < line + 1e-6) level.cloth.pinned.push_back(n);
    if (distance(nodes[n], Flat{width / 2, height}) < distance(nodes[tip], Flat{width / 2, height})) tip = n;
  }
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.stopMove = 1e-4 * free;
  settings.stopResidual = 0.1;
  settings.maxSteps = 3000;
  Workers workers(1);
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  ASSERT_TRUE(report) << text(report.error().what);
  const Vec3 end = levels[0].state.position[tip];
  const double fall = -end.y / free, reach = (end.z - line) / free;
  EXPECT_NEAR(fall, row.fall, 0.03 * row.fall);
  EXPECT_NEAR(reach, row.reach, 0.03 * row.reach);
}

INSTANTIATE_TEST_SUITE_P(Rows, LaidCantilever,
                         testing::Combine(testing::Values(Row{0.1, .01250, .99991}, Row{1, .12347, .99125},
                                                          Row{2, .23851, .96689}, Row{5, .49591, .84666},
                                                          Row{10, .70020, .65635}, Row{20, .82988, .44523},
                                                          Row{50, .90792, .24502}, Row{100, .93752, .15922, 32},
                                                          Row{300, .96501, .08629, 48}, Row{1000, .98114, .04599, 88}),
                                          testing::Values(0, 90)));

}  // namespace
}  // namespace karinui::test
