// The step's linear system against the energies it stands for: grid blocks and the remainder must make up the whole.
#include <gtest/gtest.h>

#include "cloth/bending.h"
#include "cloth/block_system.h"
#include "cloth/helpers.h"
#include "cloth/membrane.h"
#include "cloth/springs.h"

namespace karinui::test {
namespace {

// A cloth with everything in it: a grid askew in its outline, a second piece of another size, both sewn together.
ClothLevel patched() {
  Fabric f = *preset("denim");
  f.stretchWeft = 0.7 * f.stretchWarp;
  Pattern pattern = patternOf({rectangle(1, 0.31, 0.14, {0.3, 1}), rectangle(2, 0.31, 0.1)});
  Seam seam;
  seam.id = SeamId{1};
  seam.a = {{PieceId{1}, "top"}};
  seam.b = {{PieceId{2}, "bottom"}};
  pattern.seams[seam.id] = seam;
  return levelOf(pattern, 0.01, f);
}

std::vector<Vec3> stretched(const Cloth& cloth) {
  std::vector<Vec3> x;
  for (const ClothPiece& piece : cloth.pieces)
    for (Flat p : piece.lattice->nodes) x.push_back({1.1 * p.u + 0.05 * p.v, 1.15 * p.v + 0.08 * p.u, 0});
  return x;
}

struct Matrices {
  explicit Matrices(const Cloth& cloth)
      : layout(cloth),
        held(cloth.nodeCount, 0),
        tied(cloth.ties.size(), 1),
        ties(cloth, held, tied),
        stretch(cloth, layout),
        whole(cloth),
        rest(cloth, &layout),
        bending(cloth, held, layout, workers) {
    rest.appendPairs(pairs);
    system = std::make_unique<BlockSystem>(cloth, layout, bending.grid(), pairs, bending.remainder());
    system->setTies(ties);
  }
  std::vector<Vec3> gradient(const std::vector<Vec3>& x) {
    std::vector<Vec3> g(x.size());
    stretch.evaluate(x, g, system->gridStiffness(), workers);
    rest.addGradient(x, g, workers);
    bending.addGradient(x, g, workers);
    std::vector<Block3> blocks(pairs.size());
    rest.blocks(x, blocks, workers);
    system->assemble(blocks, workers);
    return g;
  }
  Workers workers{1};
  GridLayout layout;
  std::vector<std::uint8_t> held, tied;
  TieMap ties;
  GridMembrane stretch;
  Membrane whole, rest;
  Bending bending;
  std::vector<NodePair> pairs;
  std::unique_ptr<BlockSystem> system;
};

TEST(System, GridBlocksPullAsTheMembraneDoes) {
  const ClothLevel level = patched();
  Matrices of(level.cloth);
  ASSERT_EQ(of.layout.blocks.size(), 2u);
  EXPECT_LT(of.rest.count(), of.whole.count() / 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-0.001, 0.001);
  std::vector<Vec3> x = stretched(level.cloth);
  for (Vec3& p : x) p += Vec3{by(random), by(random), by(random)};
  std::vector<Vec3> expected(x.size());
  of.whole.addGradient(x, expected, of.workers);
  of.bending.addGradient(x, expected, of.workers);
  const std::vector<Vec3> found = of.gradient(x);
  double scale = 0;
  for (Vec3 g : expected) scale = std::fmax(scale, length(g));
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(length(found[k] - expected[k]), 1e-12 * scale) << k;
}

TEST(System, ProductIsTheSlopeOfTheGradient) {
  // Stretched everywhere: nothing is left out but the stress of the border's shear.
  const ClothLevel level = patched();
  Matrices of(level.cloth);
  std::vector<Vec3> x = stretched(level.cloth);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> by(-1, 1);
  std::vector<Vec3> unknown(of.ties.unknowns()), move, up = x, down = x, slope;
  for (Vec3& m : unknown) m = {by(random), by(random), by(random)};
  of.ties.expand(unknown, move);
  const double step = 1e-6;
  for (std::size_t k = 0; k < x.size(); ++k) {
    up[k] += move[k] * step;
    down[k] += move[k] * -step;
  }
  const std::vector<Vec3> after = of.gradient(up), before = of.gradient(down);
  std::vector<Vec3> change(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) change[k] = (after[k] - before[k]) * (0.5 / step);
  of.ties.reduce(change, slope);
  of.gradient(x);
  const std::vector<Vec3> found = of.system->times(unknown, of.workers);
  double scale = 0;
  for (Vec3 s : slope) scale = std::fmax(scale, length(s));
  double worst = 0, wrong = 0, all = 0;
  for (std::size_t u = 0; u < slope.size(); ++u) {
    worst = std::fmax(worst, length(found[u] - slope[u]));
    wrong += squaredLength(found[u] - slope[u]);
    all += squaredLength(slope[u]);
  }
  EXPECT_LT(worst, 2.5e-4 * scale);
  EXPECT_LT(std::sqrt(wrong / all), 1.2e-4);
}

TEST(System, SolvesWhatItMultiplies) {
  const ClothLevel level = patched();
  Matrices of(level.cloth);
  of.gradient(stretched(level.cloth));
  Block3 mass{};
  mass[0] = mass[4] = mass[8] = 5;
  for (std::uint32_t u = 0; u < of.system->unknowns(); ++u) of.system->addDiagonal(u, mass);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> by(-1, 1);
  std::vector<Vec3> expected(of.system->unknowns()), found;
  for (Vec3& m : expected) m = {by(random), by(random), by(random)};
  const std::vector<Vec3> force = of.system->times(expected, of.workers);
  of.system->solve(force, {10, 2000, 1e-5}, Token(), of.workers, found);
  for (std::size_t u = 0; u < found.size(); ++u) EXPECT_LT(length(found[u] - expected[u]), 5e-3) << u;
}

// Node by node a pull at one end takes an iteration a row to reach the other.
TEST(System, PropagatesAPullFarInFewIterations) {
  Pattern pattern = patternOf({rectangle(1, 0.2, 0.8), rectangle(2, 0.2, 0.8, {0.3, 1})});
  Seam seam;
  seam.id = SeamId{1};
  seam.a = {{PieceId{1}, "top"}};
  seam.b = {{PieceId{2}, "bottom"}};
  pattern.seams[seam.id] = seam;
  const ClothLevel level = levelOf(pattern, 0.01, *preset("denim"));
  Matrices of(level.cloth);
  of.gradient(stretched(level.cloth));
  Block3 mass{};
  mass[0] = mass[4] = mass[8] = 0.01f;
  for (std::uint32_t u = 0; u < of.system->unknowns(); ++u) of.system->addDiagonal(u, mass);
  std::vector<Vec3> force(of.system->unknowns()), found;
  const auto pulled = level.cloth.pieces[0].lattice->edges.at("bottom").nodes;
  for (const std::uint32_t node : pulled) force[of.ties.terms(node)[0].unknown] = {0, -1, 0};
  const int iterations = of.system->solve(force, {40, 4000, 0.01}, Token(), of.workers, found);
  EXPECT_LT(iterations, 100);
  const std::vector<Vec3> felt = of.system->times(found, of.workers);
  double wrong = 0, all = 0;  // in energy
  std::vector<Vec3> exact;
  of.system->solve(force, {4000, 4000, 1e-9}, Token(), of.workers, exact);
  const std::vector<Vec3> whole = of.system->times(exact, of.workers);
  for (std::size_t u = 0; u < found.size(); ++u) {
    wrong += dot(whole[u] - felt[u], exact[u] - found[u]);
    all += dot(whole[u], exact[u]);
  }
  EXPECT_LT(std::sqrt(wrong / all), 0.05);
  // One solve of a large cloth may take longer than who said stop should wait.
  Token stop;
  stop.cancel();
  EXPECT_EQ(of.system->solve(force, {4000, 4000, 1e-9}, stop, of.workers, exact), 0);
}

// Long waves of bending are soft in fine cloth; a coarse space with kinks takes them for stiff.
TEST(System, BendsFineClothOverLongWavesInFewIterations) {
  constexpr double kSide = 0.8, kSpacing = 0.005;
  const ClothLevel level = levelOf(patternOf({rectangle(1, kSide, kSide)}), kSpacing, *preset("denim"));
  ASSERT_GT(level.cloth.nodeCount, 20000u);
  Matrices of(level.cloth);
  std::vector<Vec3> x;
  for (Flat p : level.cloth.pieces[0].lattice->nodes) x.push_back({p.u, p.v, 0});
  of.gradient(x);
  Block3 mass{};
  mass[0] = mass[4] = mass[8] = 1e-4f;
  for (std::uint32_t u = 0; u < of.system->unknowns(); ++u) of.system->addDiagonal(u, mass);
  std::vector<Vec3> force(of.system->unknowns()), found;
  for (NodeIndex node = 0; node < level.cloth.nodeCount; ++node)
    force[of.ties.terms(node)[0].unknown] = {0, 0, std::cos(6 * x[node].x / kSide) * std::cos(9 * x[node].y / kSide)};
  const int iterations = of.system->solve(force, {40, 4000, 0.001}, Token(), of.workers, found);
  EXPECT_LT(iterations, 60);  // 34; with bilinear interpolation 2,185
  std::vector<Vec3> exact;
  of.system->solve(force, {40, 4000, 3e-5}, Token(), of.workers, exact);
  double energy = 0, whole = 0;
  for (std::size_t u = 0; u < found.size(); ++u) {
    energy += dot(found[u], force[u]);
    whole += dot(exact[u], force[u]);
  }
  EXPECT_NEAR(energy, whole, 1e-4 * whole);
}

// Two layers that press on each other move as one over long waves. A coarse matrix that took each for free would answer
// a force on one of them by drawing it far into the other.
TEST(System, MovesLayersInContactAsOneInFewIterations) {
  constexpr double kSide = 0.5;
  const ClothLevel level =
      levelOf(patternOf({rectangle(1, kSide, kSide), rectangle(2, kSide, kSide, {1, 0})}), 0.01, *preset("denim"));
  Matrices of(level.cloth);
  std::vector<Vec3> x;
  for (const ClothPiece& piece : level.cloth.pieces)
    for (Flat p : piece.lattice->nodes) x.push_back({p.u, p.v, 0});
  of.gradient(x);
  Block3 mass{};
  mass[0] = mass[4] = mass[8] = 1e-3f;
  for (std::uint32_t u = 0; u < of.system->unknowns(); ++u) of.system->addDiagonal(u, mass);
  const NodeIndex second = level.cloth.pieces[1].firstNode;
  std::vector<Coupling> couplings;
  std::vector<Vec3> force(of.system->unknowns()), found;
  for (NodeIndex node = 0; node < second; ++node) {
    constexpr double kApart[] = {1, -1};
    const NodeIndex nodes[] = {node, second + node};
    couplings.push_back({termsOf(of.ties, nodes, kApart), {0, 0, 1}, 30, 1});
    force[of.ties.terms(node)[0].unknown] = {0, 0, std::cos(6 * x[node].x / kSide) * std::cos(9 * x[node].y / kSide)};
  }
  of.system->setCouplings(couplings);
  const int iterations = of.system->solve(force, {40, 4000, 0.001}, Token(), of.workers, found);
  EXPECT_LT(iterations, 100);  // 79; 1,725 without the contacts in A_c
  for (NodeIndex node = 0; node < second; ++node) {
    const double one = found[of.ties.terms(node)[0].unknown].z,
                 other = found[of.ties.terms(second + node)[0].unknown].z;
    EXPECT_NEAR(one, other, 0.1 * std::fabs(one) + 0.05) << node;
  }
}

// Assembled from terms, A_c does what interpolating, multiplying and restricting do one after the other: also where
// pieces are sewn together, and beside nodes that are held. Every term has a stiffness of its own.
TEST(CoarseSpace, MatrixIsTheProductBetweenInterpolationAndRestriction) {
  const ClothLevel level = patched();
  Matrices of(level.cloth);
  for (NodeIndex node = 0; node < level.cloth.nodeCount; node += 37) of.held[node] = 1;
  of.ties = TieMap(level.cloth, of.held, of.tied);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> near(-0.001, 0.001);
  const auto between = [&](float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random);
  };
  GridBending bending = of.bending.grid();
  for (auto* stiffness : {&bending.weft, &bending.warp, &bending.twist})
    for (float& value : *stiffness) value = value > 0 ? between(0, 1) : 0;  // so that it counts beside stretch
  of.system = std::make_unique<BlockSystem>(level.cloth, of.layout, bending, of.pairs, of.bending.remainder());
  of.system->setTies(of.ties);
  of.gradient(stretched(level.cloth));
  GridStiffness& k = of.system->gridStiffness();
  for (auto* ways : {&k.weftAlong, &k.warpAlong, &k.weftWay, &k.warpWay})
    for (auto& axis : *ways)
      for (float& value : axis) value = value != 0 ? between(-1, 1) : 0;
  for (std::size_t s = 0; s < of.layout.slots; ++s) {
    for (auto* across : {&k.weftAcross, &k.warpAcross}) (*across)[s] = (*across)[s] > 0 ? between(4, 5) : 0;
    if (k.corner[s] > 0) k.corner[s] = between(0, 5);
    for (auto& angle : k.coupling) angle[s] = k.corner[s] > 0 ? between(-0.3f, 0.3f) : 0;
  }
  Block3 mass{};
  mass[0] = mass[4] = mass[8] = 0.1f;
  for (std::uint32_t u = 0; u < of.system->unknowns(); ++u) of.system->addDiagonal(u, mass);
  std::vector<Coupling> couplings;  // of cloth that lies on other cloth, or is folded
  for (int added = 0; added < 60; ++added) {
    const auto node = [&] { return static_cast<NodeIndex>(random() % level.cloth.nodeCount); };
    const NodeIndex nodes[] = {node(), node(), node(), node()};
    constexpr double kWeights[] = {1, -0.5, -0.3, -0.2};
    const Vec3 normal{between(-1, 1), between(-1, 1), between(-1, 1)};
    couplings.push_back({termsOf(of.ties, nodes, kWeights), normalized(normal), 5, 1});
  }
  of.system->setCouplings(couplings);
  CoarseSpace& coarse = of.system->coarseSpace();
  ASSERT_TRUE(coarse.assemble(of.system->stepMatrix(), of.workers));

  // The projection of a rough move: its energy in A_c and in A.
  std::vector<Vec3> rough(of.system->unknowns()), projected(rough.size());
  for (Vec3& p : rough) p = Vec3{near(random), near(random), near(random)};
  const std::vector<Vec3> force = of.system->times(rough, of.workers);
  SlotVectors r, none, move;
  for (auto* lanes : {&r, &none, &move})
    for (auto& axis : *lanes) axis.assign(of.layout.slots, 0);
  for (std::uint32_t u = 0; u < force.size(); ++u) {
    const std::size_t s = of.system->slotOf(u);
    r[0][s] = static_cast<float>(force[u].x);
    r[1][s] = static_cast<float>(force[u].y);
    r[2][s] = static_cast<float>(force[u].z);
  }
  for (const SlotRange& range : of.layout.ranges) coarse.restrictResidual(range, r);
  const double energy = coarse.coarseSolve();
  for (const SlotRange& range : of.layout.ranges) coarse.updateDirection(range, none, 0, move);
  for (std::uint32_t u = 0; u < projected.size(); ++u) {
    const std::size_t s = of.system->slotOf(u);
    projected[u] = {move[0][s], move[1][s], move[2][s]};
  }
  const std::vector<Vec3> felt = of.system->times(projected, of.workers);
  double expected = 0;
  for (std::size_t u = 0; u < felt.size(); ++u) expected += dot(felt[u], projected[u]);
  EXPECT_NEAR(energy / expected, 1, 3e-6);

  // Put together by several threads it has the same bits.
  Workers three(3);
  ASSERT_TRUE(coarse.assemble(of.system->stepMatrix(), three));
  for (const SlotRange& range : of.layout.ranges) coarse.restrictResidual(range, r);
  EXPECT_EQ(coarse.coarseSolve(), energy);
}

TEST(EnvelopeCholesky, TakesAMatrixThatIsNotPositiveOnlyWithAShift) {
  EnvelopeCholesky matrix({0, 0});  // both rows alike
  matrix.at(0, 0) = matrix.at(1, 0) = matrix.at(1, 1) = 1;
  Workers workers;
  EXPECT_FALSE(matrix.factor(workers));
  ASSERT_TRUE(matrix.factor(workers, 0.01));
  std::vector<float> x{1, 1};
  matrix.solve(x);
  EXPECT_NEAR(x[0], 1 / 2.01, 1e-5);
  EXPECT_NEAR(x[1], 1 / 2.01, 1e-5);
}

}  // namespace
}  // namespace karinui::test
