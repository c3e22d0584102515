#include <gtest/gtest.h>

#include "cloth/helpers.h"

namespace karinui::test {
namespace {

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

// Hung on the bias: under sigma N/m both threads carry half of it and so does the right angle between them, so a place
// lengthens by (e_warp(sigma/2) + e_weft(sigma/2))/2 + gamma/2, where G (gamma + k gamma^3) = sigma/2. In linear cloth
// that is a modulus of 1/(1/(4 Ku) + 1/(4 Kv) + 1/(4 G)). Between two nodes well off the clamp and the hem.
TEST(HangingStrip, OnTheBiasLengthensAsThreadsAndShearSay) {
  Fabric linear = textbook(2000, 1e-6, 0.3), uneven = linear, curved = *preset("cotton");
  linear.shear = uneven.shear = 40;
  uneven.stretchWarp = 300;
  curved.bendWarp = curved.bendWeft = 1e-6;
  curved.weight = 0.6;
  for (const Fabric& f : {linear, uneven, curved}) {
    SCOPED_TRACE(f.name + ", " + std::to_string(f.stretchWarp));
    const double length = 0.5, weight = f.weight * kGravity;
    const auto strainAt = [&](double v) {  // of paper, v up from the hem
      const double half = 0.5 * weight * v;
      double gamma = half / f.shear;
      for (int k = 0; k < 50; ++k) gamma = half / (f.shear * (1 + f.shearStiffen * gamma * gamma));
      return 0.5 * (f.warpCurve().strainAt(half) + f.weftCurve().strainAt(half)) + 0.5 * gamma;
    };
    ClothLevel level = levelOf(patternOf({rectangle(1, 0.06, length, {1, 1})}), 0.005, f);
    const auto& nodes = level.cloth.pieces[0].lattice->nodes;
    const auto nearest = [&](Flat place) {
      std::uint32_t best = 0;
      for (std::uint32_t n = 0; n < nodes.size(); ++n)
        if (distance(nodes[n], place) < distance(nodes[best], place)) best = n;
      return best;
    };
    for (std::uint32_t n = 0; n < nodes.size(); ++n)
      if (nodes[n].v > length - 1e-9) level.cloth.pinned.push_back(n);
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-6;
    settings.stopResidual = 0.01;
    settings.maxSteps = 2000;
    settings.clothOnCloth = false;
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    const std::uint32_t low = nearest({0.03, 0.05}), high = nearest({0.03, 0.4});
    double longer = 0;
    constexpr int kParts = 1000;
    for (int k = 0; k < kParts; ++k)
      longer += strainAt(nodes[low].v + (nodes[high].v - nodes[low].v) * (k + 0.5) / kParts) / kParts;
    longer *= nodes[high].v - nodes[low].v;
    const std::vector<Vec3>& x = levels[0].state.position;
    EXPECT_NEAR(x[high].y - x[low].y - (nodes[high].v - nodes[low].v), longer, 0.02 * longer);
  }
}

// Hung by both ends, limp: x = H s/K + H/w asinh(w s/H), y = w s^2/(2K) + H/w (sqrt(1 + (w s/H)^2) - 1), s from the
// middle along the unstretched cloth.
TEST(Catenary, SagsAsFarAsLengthAndStretchSay) {
  for (const double k : {2000.0, 8.0}) {
    SCOPED_TRACE(k);
    const double weight = 0.3 * kGravity, length = 0.6, apart = 0.45, h = 0.015;
    const auto half = [&](double pull) {
      return pull * length / 2 / k + pull / weight * std::asinh(weight * length / 2 / pull);
    };
    double low = 1e-6, high = 1e3;  // N/m of width
    for (int n = 0; n < 100; ++n) {
      const double middle = (low + high) / 2;
      (half(middle) < apart / 2 ? low : high) = middle;
    }
    const double end = weight * length / 2 / low;
    const double sag = weight * length * length / 8 / k + low / weight * (std::sqrt(1 + end * end) - 1);
    ClothLevel level;
    addPiece(level.cloth, gridLattice(3, 40, h), textbook(k, 1e-8, 0.3));
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      return Vec3{p.u, -0.1 * std::sin(p.v / length * std::acos(-1.0)), p.v * apart / length};
    });
    for (std::uint32_t n = 0; n < 4; ++n) level.cloth.pinned.insert(level.cloth.pinned.end(), {n, 40 * 4 + n});
    std::sort(level.cloth.pinned.begin(), level.cloth.pinned.end());
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-6;
    settings.stopResidual = 0.01;
    settings.maxSteps = 2000;
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->settled) << text(report->why);
    EXPECT_NEAR(-levels[0].state.position[20 * 4 + 1].y, sag, 0.003 * sag);
  }
}

// A strip on end, a little aslant: up to w L^3/B = 7.8373 it rights itself, beyond it it falls over.
TEST(Column, StandsUntilItsWeightBucklesIt) {
  const double weight = 0.2, length = 0.24, h = 0.01;
  for (const double times : {0.93, 1.07}) {
    SCOPED_TRACE(times);
    const double bend = weight * kGravity * length * length * length / (7.8373 * times);
    ClothLevel level;
    addPiece(level.cloth, gridLattice(4, 26, h), textbook(20000, bend, weight));
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      const double free = std::fmax(0.0, p.v - 2 * h);
      return Vec3{p.u, p.v, 0.05 * free * free / length};
    });
    for (std::uint32_t k = 0; k < 3 * 5; ++k) level.cloth.pinned.push_back(k);
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-6;
    settings.stopResidual = 0.001;
    settings.maxSteps = 3000;
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->settled) << text(report->why);
    const double aside = levels[0].state.position[26 * 5 + 2].z / length;
    if (times < 1)
      EXPECT_LT(std::fabs(aside), 0.005);
    else
      EXPECT_GT(aside, 0.3);
  }
}

TEST(Simcloth, HasOneRestWhateverTheStart) {
  // Tension only and weight: convex, so every start ends at the same place, to a micrometre.
  Fabric f = *preset("simcloth");
  f.stretchWarp = 50;
  std::vector<Vec3> first;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    ClothLevel level;
    addPiece(level.cloth, gridLattice(5, 5, 0.04), f);
    level.cloth.pinned = {30, 35};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> by(-0.1, 0.1);
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      const bool pinned = p.v > 0.19 && (p.u < 0.01 || p.u > 0.19);
      return Vec3{p.u, p.v, 0} + (pinned ? Vec3{} : Vec3{by(random), by(random), by(random)});
    });
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.stopMove = 1e-8;
    settings.stopResidual = 0.0002;
    settings.maxSteps = 1500;
    settings.clothOnCloth = false;  // a heap of crossing cloth is no convex problem
    Workers workers(1);
    const auto report = settle(levels, NoBody(), settings, Token(), workers);
    ASSERT_TRUE(report);
    ASSERT_TRUE(report->settled) << text(report->why);
    if (first.empty()) first = levels[0].state.position;
    for (std::size_t k = 0; k < first.size(); ++k)
      EXPECT_LT(distance(first[k], levels[0].state.position[k]), 1e-6) << "seed " << seed << " node " << k;
  }
}

}  // namespace
}  // namespace karinui::test
