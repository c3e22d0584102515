// The historical law on pieces as they are laid, ring and all.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/springs.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

ClothLevel laid() { return levelOf(patternOf({rectangle(1, 0.11, 0.09, {0.3, 1})}), 0.01, *preset("simcloth")); }

TEST(Simcloth, EverySpringFollowsTheLaw) {
  // K (x - x_k)(l - L)/l, only when l > L; L is the paper's, in grid and ring alike.
  const ClothLevel level = laid();
  const auto& nodes = level.cloth.pieces[0].lattice->nodes;
  const double k = level.cloth.pieces[0].fabric.stretchWarp;
  std::vector<std::uint8_t> reached(nodes.size(), 0);
  Workers workers(1);
  for (const auto& spring : simclothSprings(level.cloth)) {
    EXPECT_NEAR(spring.length, distance(nodes[spring.a], nodes[spring.b]), 1e-15);
    EXPECT_EQ(spring.stiffness, k);
    reached[spring.a] = reached[spring.b] = 1;
    const Springs one({{0, 1, spring.length, spring.stiffness}}, 2);
    for (const double times : {0.5, 0.999, 1.0, 1.001, 1.3}) {
      const Vec3 apart = normalized(Vec3{1, -2, 2}) * (spring.length * times);
      std::vector<Vec3> force(2);
      one.addGradient(std::vector<Vec3>{{}, apart}, force, workers);
      const double longer = std::fmax(0.0, length(apart) - spring.length);
      EXPECT_LT(length(force[1] - apart * (k * longer / length(apart))), 1e-9);
      EXPECT_LT(length(force[0] + force[1]), 1e-12);
    }
  }
  for (std::uint8_t r : reached) EXPECT_TRUE(r);  // no node of the ring hangs loose
}

TEST(Simcloth, RingSpringsAreTheEdgesOfItsFaces) {
  const ClothLevel level = laid();
  const Lattice& lattice = *level.cloth.pieces[0].lattice;
  std::vector<std::uint8_t> onGrid(lattice.nodes.size(), 0);
  for (std::uint32_t node : lattice.grid)
    if (node != kNoNode) onGrid[node] = 1;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges, springs;
  for (const Triangle& f : lattice.faces)
    for (int a = 0; a < 3; ++a) edges.insert(std::minmax(f[a], f[(a + 1) % 3]));
  for (const auto& s : simclothSprings(level.cloth))
    EXPECT_TRUE(springs.insert(std::minmax(s.a, s.b)).second) << "twice";
  std::size_t ring = 0;
  for (const auto& edge : edges) EXPECT_TRUE(springs.contains(edge));
  for (const auto& spring : springs) {
    if (onGrid[spring.first] && onGrid[spring.second]) continue;
    EXPECT_TRUE(edges.contains(spring));
    ++ring;
  }
  EXPECT_GT(ring, 40u);
}

TEST(Simcloth, SlackClothFeelsNothingAndStaysWhereItLies) {
  ClothLevel level = laid();
  level.cloth.pinned = {0};
  for (Vec3& p : level.state.position) p = p * 0.9 + Vec3{0, 0, 0.0005 * std::sin(300 * p.x)};
  const Springs springs(simclothSprings(level.cloth), level.cloth.nodeCount);
  Workers workers(1);
  EXPECT_EQ(springs.value(level.state.position, workers), 0);
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.gravity = {};
  settings.clothOnCloth = false;
  const auto report = settle(levels, NoBody(), settings, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << text(report->why);
  for (std::size_t k = 0; k < level.state.position.size(); ++k)
    EXPECT_LT(distance(level.state.position[k], levels[0].state.position[k]), 1e-9);
}

TEST(Simcloth, TunicHangsOnItsBodyOrSaysWhatIsLeft) {
  std::vector<ClothLevel> levels{tunic(9, *preset("simcloth")), tunic(18, *preset("simcloth"))};
  Workers workers(1);
  const auto report = settle(levels, tunicBody(), {}, Token(), workers);
  ASSERT_TRUE(report) << text(report.error().what);
  EXPECT_TRUE(report->settled || report->step > 0) << text(report->why);
  EXPECT_FALSE(text(report->why).empty());
  EXPECT_LE(report->penetration, 0.001);
  EXPECT_LE(report->seamGap, 0.0005);
  const ClothCheck found = check(levels[1].cloth, levels[1].state, nullptr);
  EXPECT_TRUE(found.finite);
  // It resists only stretch, and hardly gives there; slack regions shrink freely, so the mean says nothing.
  for (Vec3 p : levels[1].state.position) EXPECT_TRUE(p.y > -0.75 && p.y < 0.35);
}

}  // namespace
}  // namespace karinui::test
