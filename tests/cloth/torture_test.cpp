// What people do to cloth by mistake. Whatever comes of it, nothing is ever not a number, nothing passes through
// anything, no seam point is lost, and what did not come to rest is said not to have.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/level_solver.h"
#include "karinui/check/check.h"
#include "soak.h"

namespace karinui::test {
namespace {

struct Ordeal {
  SettleReport report;
  ClothCheck found;
  ClothState state;
};

Ordeal through(std::vector<ClothLevel> levels, const Collider& body, const SettleSettings& settings = {}) {
  Workers workers(1);
  const auto report = settle(levels, body, settings, Token(), workers);
  KARINUI_ASSERT(report);
  Ordeal so{*report, check(levels.back().cloth, levels.back().state, nullptr), levels.back().state};
  EXPECT_TRUE(so.found.finite);
  EXPECT_TRUE(!so.report.settled || so.found.clothClothCrossings == 0) << so.found.clothClothCrossings;
  if (so.found.clothClothCrossings > 0) {
    EXPECT_NE(text(so.report.why).find("through cloth"), std::string::npos) << text(so.report.why);
  }
  EXPECT_NEAR(so.found.seamGap, so.report.seamGap, 1e-9);
  double deepest = 0;
  for (const Vec3 p : so.state.position) deepest = std::fmax(deepest, -body.sample(p).distance);
  EXPECT_LE(deepest, so.report.penetration + 1e-6) << "the report may not flatter";
  return so;
}

// Pleated to an eighth of its width, let go on a floor; at length other cloths, in pleats of other widths.
TEST(Torture, CrumpledClothSpreadsUncrossedAndKeepsItsSize) {
  std::mt19937 dice(4);
  for (int trial = 0; trial < (atLength() ? 20 : 1); ++trial) {
    const Fabric fabric = trial == 0 ? *preset("silk") : presets()[dice() % presets().size()];
    const double pleat = trial == 0 ? 0.1 : 0.4 / static_cast<double>(2 + dice() % 5);
    SCOPED_TRACE(fabric.name + " in pleats of " + std::to_string(pleat));
    ClothLevel level;
    addPiece(level.cloth, gridLattice(24, 8, 0.4 / 24), fabric);
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      const double along = std::fmod(p.u, pleat), up = std::fmin(along, pleat - along);
      return Vec3{p.u / 8, 0.004 + std::sqrt(1 - 1.0 / 64) * up, p.v};
    });
    const Ordeal so = through({level}, PlaneBody({0, 1, 0}, 0));
    if (fabric.law == Fabric::Law::Woven) {  // the historical law lets threads shorten and shear
      EXPECT_LT(so.found.strain.mean, 0.01);
    }
    EXPECT_LE(so.report.penetration, 1e-6);
    double before = 0, after = 0;
    for (std::size_t k = 0; k < so.state.position.size(); ++k)
      before += level.state.position[k].y, after += so.state.position[k].y;
    EXPECT_LT(after, (trial == 0 ? 0.5 : 1) * before);  // stiff cloth stays upright on its pleats
    EXPECT_EQ(so.found.clothClothCrossings, 0u);
  }
}

// Two bars nearer to each other than cloth needs, a sheet between them: there is no room, and the report says so.
TEST(Torture, ClothBetweenWhatNearlyTouchesIsReportedAsItStands) {
  std::vector<double> gaps{0.0005, -0.002};
  for (int k = 0; k < 12 && atLength(); ++k) gaps.push_back(0.003 - 0.001 * k);
  for (const double gap : gaps) {
    SCOPED_TRACE(gap);
    ClothLevel level;
    addPiece(level.cloth, gridLattice(10, 20, 0.02), *preset("cotton"));
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u - 0.1, p.v - 0.2, 0}; });
    const double z = 0.05 + gap / 2;
    const CapsuleBody bars({{{-0.5, 0, z}, {0.5, 0, z}, 0.05}, {{-0.5, 0, -z}, {0.5, 0, -z}, 0.05}});
    const Ordeal so = through({level}, bars);
    if (gap < 0) {
      EXPECT_TRUE(!so.report.settled || so.report.penetration > 0);
    }
  }
}

// A figure that runs into itself: the crease between two bars that overlap.
TEST(Torture, ClothRestsInTheCreaseOfABodyThatCrossesItself) {
  std::vector<ClothLevel> levels;
  for (const std::uint32_t cells : {8u, 16u}) {
    ClothLevel level;
    addPiece(level.cloth, gridLattice(cells, cells, 0.4 / cells), *preset("cotton"));
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u - 0.2, 0.07, p.v - 0.2}; });
    levels.push_back(std::move(level));
  }
  const Ordeal so = through(
      std::move(levels), CapsuleBody({{{-1, 0, 0.045}, {1, 0, 0.045}, 0.05}, {{-1, 0, -0.045}, {1, 0, -0.045}, 0.05}}));
  EXPECT_TRUE(so.report.settled) << text(so.report.why);
  EXPECT_LE(so.report.penetration, 1e-6);
}

// From a doll's handkerchief to a sail: a curtain of the same lattice, thrice; at length up to 50 m.
TEST(Torture, DollsAndSailsHangAsCurtainsDo) {
  std::vector<double> sizes{0.05, 1.0, 10.0};
  if (atLength()) sizes.insert(sizes.end(), {0.02, 0.03, 0.08, 0.15, 0.3, 0.6, 2.0, 5.0, 20.0, 50.0});
  for (const double size : sizes) {
    SCOPED_TRACE(size);
    ClothLevel level;
    addPiece(level.cloth, gridLattice(12, 12, size / 12), *preset("cotton"));
    level.cloth.pinned = {12 * 13, 12 * 13 + 12};
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      const bool held = p.v > 0.999 * size && (p.u < 1e-9 || p.u > 0.999 * size);
      return Vec3{p.u, p.v, held ? 0 : 0.02 * size * std::sin(20 * p.u / size)};
    });
    const Ordeal so = through({level}, NoBody());
    EXPECT_LT(so.found.strain.mean, 0.01);
    for (const std::uint32_t k : level.cloth.pinned) EXPECT_EQ(so.state.position[k], level.state.position[k]);
  }
}

// One side as long as the other, twice and four times as long; at length up to ten times.
TEST(Torture, GathersOfAnyLengthCloseAndHangUncrossed) {
  std::vector<double> ratios{1.0, 2.0, 4.0};
  if (atLength()) ratios.insert(ratios.end(), {1.1, 1.3, 1.5, 1.75, 2.5, 3.0, 5.0, 6.0, 8.0, 10.0});
  for (const double ratio : ratios) {
    SCOPED_TRACE(ratio);
    const double band = 0.12;
    auto yoke = rectangle(1, band, 0.06), frill = rectangle(2, band * ratio, 0.08);
    Seam seam;
    seam.reversed = true;
    const Pattern pattern = sewnBelow(yoke, frill, seam);
    ClothChoice choice;
    for (int k = 0; k <= 6; ++k) choice.pins[yoke->id].push_back({k * band / 6, 0.06});
    std::vector<ClothLevel> levels;
    for (const double spacing : {0.02, 0.01}) {
      levels.push_back(levelOf(pattern, spacing, *preset("chiffon"), choice));
      levels.back().state = standingBy(levels.back().cloth, [&](std::size_t piece, Flat p) {
        return piece == 0 ? Vec3{p.u, p.v, 0}
                          : Vec3{p.u - 0.5 * band * (ratio - 1), p.v - 0.1, 0.002 * std::sin(300 * p.u)};
      });
    }
    const Ordeal so = through(std::move(levels), NoBody());
    EXPECT_LE(so.report.seamGap, 1e-9) << text(so.report.why);
    EXPECT_LT(so.found.strain.mean, 0.03);
    if (ratio <= 2) {
      EXPECT_EQ(so.found.clothClothCrossings, 0u);
    }
  }
}

// From gossamer to sailcloth, ten thousand times as stiff one way as the other, on ice and on glue; at length 64 of
// them.
TEST(Torture, AbsurdButSoundFabricsStayWhole) {
  std::vector<double> weights{0.01, 2.0}, wefts{10.0, 1e5}, frictions{0.0, 2.0};
  if (atLength()) weights = {0.01, 0.05, 0.3, 2.0}, wefts = {10.0, 300.0, 3000.0, 1e5}, frictions = {0, 0.2, 0.7, 2};
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t j = 0; j < wefts.size(); ++j)
      for (std::size_t k = 0; k < frictions.size(); ++k) {
        if (!atLength() && (i + j + k) % 2) continue;  // half of them: still each value of one with each of another
        const double weight = weights[i], weft = wefts[j], friction = frictions[k];
        SCOPED_TRACE(std::to_string(weight) + " kg/m2, " + std::to_string(weft) + " N/m, " + std::to_string(friction));
        Fabric f = *preset("cotton");
        f.weight = weight, f.stretchWeft = weft, f.frictionBody = f.frictionCloth = friction;
        f.stretchWarp = weft > 100 ? 10 : 1e5;
        const Ordeal so = through({tunic(6, f), tunic(12, f)}, tunicBody());
        EXPECT_LE(so.report.penetration, 1e-6);
        EXPECT_LE(so.report.seamGap, 0.0005) << text(so.report.why);
      }
}

// A tunic stepped at a tenth of the usual time, as it is, and after a stall or a pause: whatever a step is given, all
// stays finite, sewn, outside the body and uncrossed, and does not fly off.
TEST(Torture, StepsOfAnyLengthKeepTheCloth) {
  std::vector<ClothLevel> levels{tunic(6, *preset("cotton")), tunic(12, *preset("cotton"))};
  const Ordeal before = through(levels, tunicBody());
  ASSERT_TRUE(before.report.settled);
  Workers workers(1);
  const CapsuleBody body = tunicBody();
  std::vector<double> times{1.0 / 600, 1.0 / 60, 4.0 / 60, 16.0 / 60, 3600.0};
  if (atLength())
    times.insert(times.end(),
                 {1.0 / 6000, 1.0 / 1000, 1.0 / 240, 1.0 / 120, 1.0 / 30, 0.1, 0.25, 1.0, 10.0, 60.0, 1e6});
  for (const double seconds : times) {
    SCOPED_TRACE(seconds);
    LevelSolver solver(levels[1].cloth, before.state.position, body, {}, 0.002, workers);
    solver.tieWithin(levels[1].cloth.spacing);
    LevelSolver::StepOptions options;
    options.mostMove = levels[1].cloth.spacing;
    options.gravity = {0, -9.81, 0};
    for (int k = 0; k < soak(30); ++k) {
      options.seconds = k % 10 == 5 ? seconds : 1.0 / 60;  // once in a while, as a stall comes; then from there on
      if (k > 15) options.seconds = seconds;
      ASSERT_TRUE(solver.step(options, Token()).finite) << k;
    }
    ClothState state{solver.positions()};
    const ClothCheck found = check(levels[1].cloth, state, nullptr);
    EXPECT_TRUE(found.finite);
    EXPECT_EQ(found.clothClothCrossings, 0u);
    EXPECT_LE(found.seamGap, 1e-9);
    for (std::size_t k = 0; k < state.position.size(); ++k) {
      EXPECT_GT(body.sample(state.position[k]).distance, -0.001);
      EXPECT_LT(distance(state.position[k], before.state.position[k]), 0.05);
    }
  }
}

// A handkerchief falls onto a sheet that is held, and onto a board of bars 6 mm thick, as far in a step as a step may
// carry it, 1 cm: it lands on them.
TEST(Torture, WhatFallsFastLandsOnWhatIsThin) {
  for (const bool onCloth : {true, false}) {
    SCOPED_TRACE(onCloth ? "on cloth" : "on bars");
    ClothLevel level;
    addPiece(level.cloth, gridLattice(6, 6, 0.01), *preset("cotton"));
    if (onCloth) addPiece(level.cloth, gridLattice(14, 14, 0.01, {-0.04, -0.04}), *preset("cotton"), false);
    level.state = standingBy(level.cloth, [](std::size_t piece, Flat p) {
      return Vec3{p.u, piece == 0 ? 0.15 + 0.1 * p.u + 0.05 * p.v : 0.0, p.v};
    });
    std::vector<CapsuleBody::Capsule> bars;
    for (int k = -20; k < 50 && !onCloth; ++k) bars.push_back({{-1, -0.003, 0.002 * k}, {1, -0.003, 0.002 * k}, 0.003});
    const CapsuleBody body(bars);
    Workers workers(1);
    LevelSolver solver(level.cloth, level.state.position, body, {}, 0.002, workers);
    LevelSolver::StepOptions options;
    options.seconds = 1.0 / 60;
    options.mostMove = level.cloth.spacing;
    options.gravity = {0, -98.1, 0};
    for (int k = 0; k < 60; ++k) {
      options.seconds = k % 3 == 1 ? 4.0 / 60 : 1.0 / 60;
      ASSERT_TRUE(solver.step(options, Token()).finite);
      const ClothCheck found = check(level.cloth, {solver.positions()}, nullptr);
      ASSERT_EQ(found.clothClothCrossings, 0u) << k;
      for (std::uint32_t n = 0; n < 49; ++n) ASSERT_GT(solver.positions()[n].y, -0.001) << k;
    }
  }
}

// A hem jerked at 5 m/s and a target that leaps a metre away and back, at the rate a device sends; between them places
// that are no numbers, which are refused and move nothing. Let go, the tunic is whole.
TEST(Torture, AHandThatJerksLeapsAndStammersTearsNothing) {
  std::vector<ClothLevel> levels{tunic(6, *preset("cotton")), tunic(12, *preset("cotton"))};
  const Ordeal before = through(levels, tunicBody());
  ASSERT_TRUE(before.report.settled);
  const CapsuleBody body = tunicBody();
  Workers workers(1);
  SettleSettings settings;
  settings.maxSteps = 100;
  std::mt19937 dice(5);
  for (int trial = 0; trial < (atLength() ? 200 : 6); ++trial) {
    SCOPED_TRACE(trial);
    ClothLevel level{levels[1].cloth, before.state};
    Grip grip;
    grip.nodes = {static_cast<std::uint32_t>(dice() % level.cloth.nodeCount)};
    Vec3 at = level.state.position[grip.nodes[0]];
    grip.path = {at};
    const auto sway = [&] { return (static_cast<double>(dice() % 2001) - 1000) / 1000; };
    for (int k = 0; k < (trial % 2 ? 2 : 6); ++k) {
      const Vec3 way = normalized(Vec3{sway(), sway(), sway()});
      at += way * (trial % 2 ? 1.0 : 5.0 / 60);
      grip.path.push_back(at);
      if (trial % 2) grip.path.push_back(at - way);
    }
    grip.seconds = static_cast<double>(grip.path.size()) / 60;
    grip.letGo = trial % 3 == 0;
    Grip stammering = grip;
    stammering.path[1].y = trial % 2 ? std::nan("") : HUGE_VAL;
    EXPECT_FALSE(pull(level, body, stammering, settings, Token(), workers));
    EXPECT_EQ(level.state.position, before.state.position);
    const auto report = pull(level, body, grip, settings, Token(), workers);
    ASSERT_TRUE(report) << text(report.error().what);
    const ClothCheck found = check(level.cloth, level.state, nullptr);
    EXPECT_TRUE(found.finite);
    EXPECT_LE(found.seamGap, 0.0005);
    // Wrung, cells of 5 cm may pass through each other; then that is what the report says.
    EXPECT_TRUE(!report->end.settled || found.clothClothCrossings == 0);
    if (found.clothClothCrossings > 0) {
      EXPECT_NE(text(report->end.why).find("through cloth"), std::string::npos) << text(report->end.why);
    }
    for (const Vec3 f : report->force) EXPECT_LE(length(f), 40.001);  // no stronger than a hand
  }
}

// A body that answers nonsense now and then: what is no number is noticed in the step it comes up in, and the cloth
// stays where it stood.
class MadBody : public CapsuleBody {
 public:
  MadBody(double distance, Vec3 normal, int sane) : CapsuleBody(tunicBody()), mad_{distance, normal}, sane_(sane) {}
  Sample sample(Vec3 p) const override { return ++asked_ > sane_ ? mad_ : CapsuleBody::sample(p); }
  double clearance(Vec3) const override { return -1; }
  Sample exactSample(Vec3 p) const override { return CapsuleBody::sample(p); }
  int asked() const { return asked_; }

 private:
  Sample mad_;
  int sane_;
  mutable int asked_ = 0;
};

TEST(Torture, WhatIsNoNumberIsRefusedAndSpreadsNowhere) {
  const double nan = std::nan(""), huge = HUGE_VAL;
  for (const auto& [distance, normal] : {std::pair<double, Vec3>{-0.001, {nan, 0, 0}},
                                         {-huge, {0, 1, 0}},
                                         {-0.001, {0, huge, 0}},
                                         {-1e300, {1e300, 0, 0}}})
    for (const int sane : {0, 3000, 30000}) {
      SCOPED_TRACE(std::to_string(distance) + ", " + std::to_string(normal.x) + ", after " + std::to_string(sane));
      std::vector<ClothLevel> levels{tunic(6, *preset("cotton")), tunic(12, *preset("cotton"))};
      const std::vector<Vec3> before = levels.back().state.position;
      const MadBody body(distance, normal, sane);
      Workers workers(1);
      const auto report = settle(levels, body, {}, Token(), workers);
      EXPECT_FALSE(report);
      EXPECT_EQ(levels.back().state.position, before);
      EXPECT_LT(body.asked(), sane + 20'000) << "noticed late";
    }
}

// Ten times in a row, as if nothing had been before: garments of three kinds, each time at rest, each time the same
// bits for one, two and four threads.
TEST(Torture, AgainAndAgainIsTheSame) {
  const Fabric cotton = *preset("cotton"), simcloth = *preset("simcloth");
  const auto curtain = [&] {
    Pattern pattern = patternOf({rectangle(1, 0.3, 0.25, {0.3, 1})});
    ClothLevel level = levelOf(pattern, 0.02, cotton);
    for (std::uint32_t k : level.cloth.pieces[0].lattice->edges.at("top").nodes) level.cloth.pinned.push_back(k);
    std::sort(level.cloth.pinned.begin(), level.cloth.pinned.end());
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{0.9 * p.u, 0, -p.v}; });
    return std::vector<ClothLevel>{level};
  };
  const auto coat = [&] { return std::vector<ClothLevel>{tunic(6, cotton), tunic(12, cotton)}; };
  const auto tension = [&] {
    ClothLevel level;
    addPiece(level.cloth, gridLattice(12, 12, 0.02), simcloth);
    level.cloth.pinned = {12 * 13, 12 * 13 + 12};
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, p.v, 0.01 * p.u}; });
    return std::vector<ClothLevel>{level};
  };
  const std::function<std::vector<ClothLevel>()> scenes[] = {curtain, coat, tension};
  const NoBody nobody;
  const CapsuleBody body = tunicBody();
  for (int scene = 0; scene < 3; ++scene) {
    SCOPED_TRACE(scene);
    std::vector<Vec3> first;
    for (int run = 0; run < (atLength() ? 10 : 3); ++run) {
      Workers workers(run % 3 == 2 ? 4 : run % 3 + 1);
      auto levels = scenes[scene]();
      const auto report =
          settle(levels, scene == 1 ? static_cast<const Collider&>(body) : nobody, {}, Token(), workers);
      ASSERT_TRUE(report);
      ASSERT_TRUE(report->settled) << text(report->why);
      if (run == 0) first = levels.back().state.position;
      ASSERT_EQ(levels.back().state.position, first) << "run " << run << ", " << workers.threads() << " threads";
    }
  }
}

}  // namespace
}  // namespace karinui::test
