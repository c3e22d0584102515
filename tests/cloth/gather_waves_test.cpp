// Cloth that is gathered much is laid in even waves before it is drawn in.
#include "karinui/cloth/gather_waves.h"

#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/check/check.h"
#include "soak.h"

namespace karinui::test {
namespace {

constexpr double kBand = 0.12, kDeep = 0.15;

// A frill below a band that is pinned along its top.
ClothLevel frill(double ratio) {
  auto yoke = rectangle(1, kBand, 0.03), gathered = rectangle(2, kBand * ratio, kDeep);
  Seam seam;
  seam.tie = Seam::Tie::TwoToOne;
  seam.reversed = true;
  const Pattern pattern = sewnBelow(yoke, gathered, seam);
  ClothChoice choice;
  for (int k = 0; k <= 12; ++k) choice.pins[yoke->id].push_back({k * kBand / 12, 0.03});
  ClothLevel level = levelOf(pattern, 0.01, *preset("cotton"), choice);
  level.state = standingBy(level.cloth, [&](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u, p.v, 0} : Vec3{p.u - 0.5 * kBand * (ratio - 1), p.v - kDeep - 0.01, 0};
  });
  return level;
}

double width(const ClothPiece& piece, const std::vector<Vec3>& x) {
  double low = 1e300, high = -1e300;
  for (std::size_t k = 0; k < piece.lattice->nodes.size(); ++k) {
    low = std::min(low, x[piece.firstNode + k].x);
    high = std::max(high, x[piece.firstNode + k].x);
  }
  return high - low;
}

TEST(GatherWaves, AreAsWideAsWhatTheyAreSewnToAndStretchNothing) {
  for (const double ratio : {2.5, 4.0, 10.0}) {
    SCOPED_TRACE(ratio);
    ClothLevel level = frill(ratio);
    const std::vector<Vec3> before = level.state.position;
    ASSERT_TRUE(layGathersInWaves(level.cloth, level.state.position));
    const std::vector<Vec3>& x = level.state.position;
    const ClothPiece &band = level.cloth.pieces[0], &gathered = level.cloth.pieces[1];
    EXPECT_TRUE(std::equal(x.begin(), x.begin() + static_cast<long>(band.lattice->nodes.size()), before.begin()));
    EXPECT_NEAR(width(gathered, x), kBand, 0.1 * kBand);
    for (const Tie& tie : level.cloth.ties) {
      // One pair in the middle of the edge may take a node more.
      if (tie.c == kNoNode || length(before[tie.b] - before[tie.c]) > 0.016) continue;
      const Vec3 middle = (x[tie.b] + x[tie.c]) * 0.5;
      EXPECT_NEAR(middle.x, x[tie.a].x, 0.1 * kBand / ratio + 0.003);
      EXPECT_NEAR(middle.z, 0, 0.0005);
      EXPECT_NEAR(length(x[tie.b] - x[tie.c]), length(before[tie.b] - before[tie.c]), 1e-4);
    }
    for (const Triangle& f : gathered.lattice->faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto one = f[k], other = f[(k + 1) % 3];
        EXPECT_LE(length(x[gathered.firstNode + one] - x[gathered.firstNode + other]),
                  distance(gathered.lattice->nodes[one], gathered.lattice->nodes[other]) + 1e-6);
      }
  }
}

TEST(GatherWaves, AreLeftOutOfGathersThatAreDrawnInFlatOfPiecesThatStandRoundOrArePinned) {
  ClothLevel even = frill(2);
  EXPECT_FALSE(layGathersInWaves(even.cloth, even.state.position));
  ClothLevel round = frill(4);
  for (Vec3& p : round.state.position) p.z += 0.1 * p.x * p.x;
  const std::vector<Vec3> before = round.state.position;
  EXPECT_FALSE(layGathersInWaves(round.cloth, round.state.position));
  EXPECT_EQ(round.state.position, before);
  ClothLevel pinned = frill(4);  // what is pinned stays where it was put
  pinned.cloth.pinned.push_back(pinned.cloth.pieces[1].firstNode);
  EXPECT_FALSE(layGathersInWaves(pinned.cloth, pinned.state.position));
}

TEST(GatherWaves, ComeToRestUncrossed) {
  for (const double ratio : {3.0, 5.0, 10.0}) {
    if (ratio > 5 && !atLength()) continue;
    SCOPED_TRACE(ratio);
    ClothLevel level = frill(ratio);
    level.cloth.pleated = layGathersInWaves(level.cloth, level.state.position);
    std::vector<ClothLevel> levels{std::move(level)};
    Workers workers(1);
    const auto report = settle(levels, NoBody(), {}, Token(), workers);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->settled) << text(report->why);
    const ClothCheck found = check(levels[0].cloth, levels[0].state, nullptr);
    EXPECT_EQ(found.clothClothCrossings, 0u);
    EXPECT_LE(found.seamGap, 1e-9);
    EXPECT_LT(found.strain.mean, 0.01);
  }
}

}  // namespace
}  // namespace karinui::test
