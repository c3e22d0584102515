#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "cloth/finish.h"
#include "cloth/helpers.h"
#include "karinui/base/hash.h"
#include "karinui/check/check.h"
#include "karinui/cloth/floor.h"

namespace karinui::test {
namespace {

std::string hashOf(const ClothState& state) { return Hasher().add(std::span<const Vec3>(state.position)).hex(); }

SettleReport mustSettle(std::vector<ClothLevel>& levels, const Collider& body, int threads = 1,
                        const SettleSettings& settings = {}, const SettleWatcher& watcher = {}) {
  Workers workers(threads);
  const auto report = settle(levels, body, settings, Token(), workers, watcher);
  KARINUI_ASSERT(report);
  return *report;
}

std::vector<ClothLevel> tunicLevels() {
  const Fabric f = *preset("cotton");
  return {tunic(9, f), tunic(18, f)};
}

// A square of cotton, pinned along two sides that are so many of its widths farther apart than it is wide.
std::vector<ClothLevel> drawnApart(const std::string& name, std::uint32_t cells, double height, double widths) {
  constexpr double kCell = 0.01;
  ClothLevel level;
  addPiece(level.cloth, gridLattice(cells, cells, kCell), *preset("cotton"));
  level.cloth.pieces.front().name = name;
  level.cloth.spacing = kCell;
  level.state = standingBy(level.cloth, [&](std::size_t, Flat p) { return Vec3{p.u, height + p.v, 0}; });
  for (std::uint32_t row = 0; row <= cells; ++row)
    for (const std::uint32_t column : {0u, cells}) {
      const std::uint32_t node = row * (cells + 1) + column;
      level.cloth.pinned.push_back(node);
      if (column > 0) level.state.position[node].x += widths * cells * kCell;
    }
  return {level};
}

// As what is tied through a body is.
TEST(Settle, TornClothIsToldInAFewSteps) {
  auto levels = drawnApart("pareo", 12, 3, 40);
  const SettleReport report = mustSettle(levels, *floorCollider());
  EXPECT_FALSE(report.settled);
  EXPECT_LT(report.steps, 200u);
  EXPECT_THAT(text(report.why), testing::AllOf(testing::HasSubstr("is torn: threads of “pareo”"),
                                               testing::HasSubstr("place the pieces where they are worn")));
}

// It rests, but no garment is worn so.
TEST(Settle, ClothThatIsCaughtAtRestIsToldOf) {
  auto levels = drawnApart("cape", 4, 0.9, 1.5);
  SettleReport report = mustSettle(levels, *floorCollider());
  EXPECT_TRUE(report.settled) << text(report.why);
  ASSERT_TRUE(adviceOn(report));
  EXPECT_THAT(
      text(*adviceOn(report)),
      testing::MatchesRegex("Threads of “cape” are drawn out to 2\\.[5-9] times their length, about 9[0-4] cm.*"));
  auto worn = tunicLevels();
  report = mustSettle(worn, tunicBody());
  EXPECT_FALSE(adviceOn(report));
  EXPECT_EQ(text(report.why), "At rest.");
}

// Arms that hang lower than the sides are sewn up to: the sides close through them. Draped on, it was torn after
// hundreds of fine steps.
TEST(Settle, ClothSewnUpRoundALimbIsGivenUpOnACoarseLevel) {
  const CapsuleBody hanging({{{0, -0.16, 0}, {0, 0.16, 0}, 0.14},
                             {{0.10, 0.18, 0}, {0.42, -0.20, 0}, 0.05},
                             {{-0.10, 0.18, 0}, {-0.42, -0.20, 0}, 0.05}});
  auto levels = tunicLevels();
  const SettleReport report = mustSettle(levels, hanging);
  EXPECT_FALSE(report.settled);
  EXPECT_EQ(report.fineSteps, 0u);
  EXPECT_THAT(text(report.why),
              testing::AllOf(testing::HasSubstr("The body goes through"), testing::HasSubstr("pose name=T")));
}

TEST(Settle, TunicComesToRestOnItsBody) {
  auto levels = tunicLevels();
  const SettleReport report = mustSettle(levels, tunicBody());
  EXPECT_TRUE(report.settled) << text(report.why);
  EXPECT_LE(report.seamGap, 0.0005);
  EXPECT_LE(report.penetration, 1e-6);
  EXPECT_LT(report.strain.mean, 0.01);
  EXPECT_LT(report.residual, 0.4);
  EXPECT_GT(report.steps, 0u);
  const ClothCheck found = check(levels.back().cloth, levels.back().state, nullptr);
  EXPECT_TRUE(found.finite);
  EXPECT_EQ(found.clothClothCrossings, 0u);
  EXPECT_NEAR(found.strain.mean, report.strain.mean, 1e-9);
  // It hangs from the arms: no lower than it can reach, no higher than it was.
  for (Vec3 p : levels.back().state.position) {
    EXPECT_GT(p.y, -0.7);
    EXPECT_LT(p.y, 0.33);
  }
}

TEST(Settle, SameBitsForOneAndTwoThreads) {
  auto one = tunicLevels(), two = tunicLevels();
  mustSettle(one, tunicBody(), 1);
  mustSettle(two, tunicBody(), 2);
  EXPECT_EQ(hashOf(one.back().state), hashOf(two.back().state));
}

TEST(Settle, AnOnlookerSeesEveryStepAndChangesNothing) {
  const Fabric f = *preset("cotton");
  std::vector<ClothLevel> alone{tunic(5, f), tunic(9, f)}, watched = alone;
  mustSettle(alone, tunicBody(), 1);
  std::size_t looks = 0;
  std::vector<Vec3> last;
  Workers workers(1);
  const auto report = settle(watched, tunicBody(), {}, {}, workers, [&](const Cloth& cloth, const auto& places) {
    EXPECT_EQ(places.size(), cloth.nodeCount);
    ++looks, last = places;
  });
  ASSERT_TRUE(report);
  EXPECT_EQ(looks, report->steps);
  EXPECT_EQ(hashOf(watched.back().state), hashOf(alone.back().state));
  ASSERT_EQ(last.size(), watched.back().state.position.size());
  for (std::size_t k = 0; k < last.size(); ++k)  // from there it is only lifted off the skin
    EXPECT_LT(distance(last[k], watched.back().state.position[k]), 0.01);
}

// Going on from rest tells how far it leads, and leaves the outcome where rest was called.
TEST(Settle, MeasuresRestAndChangesNothing) {
  const Fabric f = *preset("cotton");
  std::vector<ClothLevel> plain{tunic(5, f), tunic(9, f)}, continued = plain;
  mustSettle(plain, tunicBody(), 1);
  Workers workers(1);
  SettleSettings settings;
  settings.continueAfterRest = true;
  const auto report = settle(continued, tunicBody(), settings, {}, workers);
  ASSERT_TRUE(report);
  EXPECT_EQ(hashOf(continued.back().state), hashOf(plain.back().state));
  ASSERT_TRUE(report->continuation);
  const Continuation& more = *report->continuation;
  EXPECT_TRUE(more.settled || more.steps >= 500);
  EXPECT_GT(more.steps, 0u);
  EXPECT_GT(more.max, 0);
  EXPECT_LE(more.p99, more.max);
  EXPECT_LE(more.p95, more.p99);
  EXPECT_LT(report->fineSteps, report->steps);
  ASSERT_EQ(report->energy.size(), report->fineSteps + more.steps);
  EXPECT_LE(report->energy.back().joules, report->energy[report->fineSteps - 1].joules);
  EXPECT_LT(report->energy.back().joules, report->energy.front().joules);
}

// A cloth so large that every loop and every sum is cut into several blocks (the largest have 2048 nodes), on a body,
// touching itself: smaller ones are summed in one piece and would come out the same anyhow.
TEST(Settle, SameBitsForAnyTeamWhereThereIsWorkForAll) {
  ClothLevel level;
  addPiece(level.cloth, gridLattice(64, 64, 0.012), *preset("cotton"));
  addPiece(level.cloth, gridLattice(32, 32, 0.012), *preset("denim"));
  level.state = standingBy(level.cloth, [](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u - 0.4, 0.301, p.v - 0.37} : Vec3{p.u - 0.2, 0.3025, p.v - 0.2};
  });
  SettleSettings settings;
  settings.maxSteps = 8;
  std::string first;
  for (const int threads : {1, 2, 4}) {
    std::vector<ClothLevel> levels{level};
    mustSettle(levels, CapsuleBody({{{}, {}, 0.3}}), threads, settings);
    if (first.empty()) first = hashOf(levels[0].state);
    EXPECT_EQ(hashOf(levels[0].state), first) << threads << " threads";
  }
}

// Every step asks whether it is still wanted, from the first seam drawn together to the last look at the rest: none is
// begun after somebody said stop, and a step is some milliseconds for each ten thousand nodes.
TEST(Settle, StopsWithinAStepWhereverItIsAndLeavesTheStateAlone) {
  std::vector<std::string> stages;
  std::size_t steps = 0;
  const auto run = [&](std::size_t stopAt) {
    auto levels = tunicLevels();
    const std::string before = hashOf(levels.back().state);
    std::size_t calls = 0;
    Token* self = nullptr;
    Token token([&](double, const Message& doing) {
      if (stopAt == 0) stages.push_back(text(doing));
      if (++calls == stopAt) self->cancel();
    });
    self = &token;
    Workers workers(1);
    const auto report = settle(levels, tunicBody(), {}, token, workers);
    if (stopAt == 0) {
      KARINUI_ASSERT(report);
      steps = report->steps;
      return;
    }
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, Error::Kind::Cancelled);
    EXPECT_EQ(calls, stopAt);  // not one step more
    EXPECT_EQ(hashOf(levels.back().state), before);
  };
  run(0);
  EXPECT_EQ(stages.size(), steps);  // it is heard of at every step
  const auto draping = static_cast<std::size_t>(std::find(stages.begin(), stages.end(), "Draping") - stages.begin());
  ASSERT_GT(draping, 2u);
  for (const std::size_t at : {std::size_t{1}, draping / 2, draping, draping + 1, draping + 20, steps - 1, steps}) {
    SCOPED_TRACE(at);
    run(at);
  }
}

TEST(Settle, FrozenPiecesDoNotMoveAndHoldWhatIsSewnToThem) {
  ClothLevel level = tunic(12, *preset("cotton"));
  level.cloth.pieces[1].live = false;
  const std::vector<Vec3> before = level.state.position;
  const std::uint32_t back = level.cloth.pieces[1].firstNode;
  std::vector<ClothLevel> levels{level};
  const SettleReport report = mustSettle(levels, NoBody());
  EXPECT_TRUE(report.settled) << text(report.why);
  for (std::size_t k = back; k < before.size(); ++k) EXPECT_EQ(levels[0].state.position[k], before[k]);
  EXPECT_LE(report.seamGap, 1e-12);
}

// A cloth hangs slack from two corners and holds another, sewn on below. Standing still it is named only where it would
// give way: not when the lower one comes to rest again as it was, but when that is twenty times as heavy.
TEST(Settle, NamesWhatWouldGiveWayWereItLive) {
  constexpr std::uint32_t kColumns = 12, kRows = 6;
  constexpr double kCell = 0.03;
  ClothLevel level;
  const Fabric cotton = *preset("cotton");
  const std::uint32_t upper = addPiece(level.cloth, gridLattice(kColumns, kRows, kCell), cotton),
                      lower = addPiece(level.cloth, gridLattice(kColumns, kRows, kCell), cotton);
  level.cloth.seams = {SeamId{1}};
  for (std::uint32_t i = 0; i <= kColumns; ++i)
    level.cloth.ties.push_back({upper + i, lower + kRows * (kColumns + 1) + i, kNoNode, 0});
  level.cloth.pinned = {upper + kRows * (kColumns + 1), upper + kRows * (kColumns + 1) + kColumns};
  level.state = standingBy(level.cloth, [&](std::size_t piece, Flat p) {
    return Vec3{0.85 * p.u, p.v + (piece == 0 ? kRows * kCell : 0), 0.2 * p.u * (kColumns * kCell - p.u)};
  });
  std::vector<ClothLevel> levels{level};
  ASSERT_TRUE(mustSettle(levels, NoBody()).toActivate.empty()) << "all is live";
  ClothPiece &still = levels[0].cloth.pieces[0], &live = levels[0].cloth.pieces[1];
  still.live = false;
  EXPECT_TRUE(mustSettle(levels, NoBody()).toActivate.empty());
  live.fabric.weight *= 20;
  EXPECT_EQ(mustSettle(levels, NoBody()).toActivate, std::vector{still.id});
}

TEST(Settle, ClothThatNothingHoldsIsSaidToFall) {
  ClothLevel level;
  Fabric slippery = *preset("silk");
  slippery.frictionBody = 0;
  addPiece(level.cloth, gridLattice(10, 10, 0.02), slippery);
  level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u + 0.2, 0.31, p.v - 0.1}; });
  std::vector<ClothLevel> levels{level};
  const SettleReport report = mustSettle(levels, CapsuleBody({{{0, 0, 0}, {0, 0, 0}, 0.3}}));
  EXPECT_FALSE(report.settled);
  EXPECT_NE(text(report.why).find("falls"), std::string::npos) << text(report.why);
  EXPECT_LE(report.steps, 400u);
}

TEST(Settle, FrictionHoldsOnASlopeThatIsGentleEnough) {
  for (const bool holds : {true, false}) {
    const double slope = std::atan(0.3) + (holds ? -0.05 : 0.3);
    Fabric f = *preset("denim");
    f.frictionBody = 0.3;
    ClothLevel level;
    addPiece(level.cloth, gridLattice(8, 8, 0.02), f);
    const Vec3 down{std::cos(slope), -std::sin(slope), 0}, out{std::sin(slope), std::cos(slope), 0};
    level.state = standingBy(level.cloth, [&](std::size_t, Flat p) {
      return down * p.u + Vec3{0, 0, p.v} + out * 0.0014;
    });
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    settings.maxSteps = 120;
    const SettleReport report = mustSettle(levels, PlaneBody(out, 0), 1, settings);
    double moved = 0;
    for (std::size_t k = 0; k < level.state.position.size(); ++k)
      moved = std::fmax(moved, distance(level.state.position[k], levels[0].state.position[k]));
    if (holds) {
      EXPECT_TRUE(report.settled) << text(report.why);
      EXPECT_LT(moved, 0.002);
    } else {
      EXPECT_FALSE(report.settled);
      EXPECT_GT(moved, 0.02);
    }
  }
}

TEST(Settle, TubeOfOnePieceClosesRoundALimb) {
  auto piece = rectangle(1, 0.4, 0.2);
  Pattern pattern = patternOf({piece});
  Seam seam;
  seam.id = SeamId{1};
  seam.name = "underarm";
  seam.a = {{piece->id, "left"}};
  seam.b = {{piece->id, "right"}};
  pattern.seams[seam.id] = seam;
  std::vector<ClothLevel> levels{levelOf(pattern, 0.04, *preset("cotton")), levelOf(pattern, 0.02, *preset("cotton"))};
  // Wrapped loosely about the limb, a hand's breadth open.
  for (ClothLevel& level : levels)
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) {
      const double turn = 5.4 * (p.u / 0.4 - 0.5);
      return Vec3{p.v - 0.1, 0.02 - 0.074 * std::cos(turn), 0.074 * std::sin(turn)};
    });
  ASSERT_FALSE(levels[1].cloth.ties.empty());
  const SettleReport report = mustSettle(levels, CapsuleBody({{{-0.5, 0, 0}, {0.5, 0, 0}, 0.045}}));
  EXPECT_TRUE(report.settled) << text(report.why);
  EXPECT_LE(report.seamGap, 1e-9);
  EXPECT_LE(report.penetration, 1e-6);
}

TEST(Settle, FoldedPairsMeetTheirSinglePointInTheMiddle) {
  auto shorter = rectangle(1, 0.2, 0.1), longer = rectangle(2, 0.4, 0.1);
  Seam seam;
  seam.tie = Seam::Tie::TwoToOne;
  const Pattern pattern = sewnBelow(shorter, longer, seam);
  ClothChoice choice;
  choice.pins[shorter->id] = {{0, 0.1}, {0.2, 0.1}};
  ClothLevel level = levelOf(pattern, 0.02, *preset("silk"), choice);
  int folded = 0;
  for (const Tie& tie : level.cloth.ties) folded += tie.c != kNoNode;
  ASSERT_GT(folded, 3);
  level.state = standingBy(level.cloth, [](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u, p.v, 0} : Vec3{p.u - 0.1, p.v - 0.12, 0.002 * std::sin(60 * p.u)};
  });
  std::vector<ClothLevel> levels{level};
  SettleSettings settings;
  settings.maxSteps = 800;
  const SettleReport report = mustSettle(levels, NoBody(), 1, settings);
  EXPECT_LE(report.seamGap, 1e-9);
  for (const Tie& tie : level.cloth.ties)
    if (tie.c != kNoNode) {
      const auto& x = levels[0].state.position;
      EXPECT_LT(distance(x[tie.a], (x[tie.b] + x[tie.c]) * 0.5), 1e-9);
    }
}

TEST(Settle, ASecondSettleStartsFromWhereTheClothRests) {
  auto levels = tunicLevels();
  const SettleReport first = mustSettle(levels, tunicBody());
  const std::vector<Vec3> rested = levels.back().state.position;
  const SettleReport again = mustSettle(levels, tunicBody());
  EXPECT_TRUE(again.settled);
  // Which fold slips last is chance, so the count says little more than that it did not begin anew.
  EXPECT_LT(again.steps, first.steps);
  Vec3 drift;
  for (std::size_t k = 0; k < rested.size(); ++k) drift += levels.back().state.position[k] - rested[k];
  EXPECT_LT(length(drift) / static_cast<double>(rested.size()), 0.003);
}

// The widest spacing of the levels a drape went through.
SettleReport settledFrom(std::vector<ClothLevel>& levels, double& widest, const SettleSettings& settings = {}) {
  widest = 0;
  return mustSettle(levels, tunicBody(), 1, settings,
                    [&](const Cloth& cloth, const std::vector<Vec3>&) { widest = std::fmax(widest, cloth.spacing); });
}

// A side seam pulled open by 3 cm, as by a change of the pattern. Told that it had rested, the cloth rests after fewer
// linear solves, and as well.
TEST(Settle, ASeamThatStandsALittleOpenIsClosedWhereItIs) {
  auto levels = tunicLevels();
  mustSettle(levels, tunicBody());
  ClothLevel& finest = levels.back();
  const std::vector<Vec3> rested = finest.state.position;
  const ClothPiece& front = finest.cloth.pieces[0];
  for (std::uint32_t k = 0; k < front.lattice->nodes.size(); ++k) {
    const Flat p = front.lattice->nodes[k];
    const double near = std::fmax(0, 1 - length(p - Flat{0.6, 0.2}) / 0.15);
    finest.state.position[front.firstNode + k].x -= 0.03 * near;
  }
  double open = 0;
  for (const Tie& tie : finest.cloth.ties)
    open = std::fmax(open, distance(finest.state.position[tie.a], finest.state.position[tie.b]));
  ASSERT_GT(open, finest.cloth.spacing / 2) << "it does stand open";
  const std::vector<ClothLevel> opened = levels;
  std::size_t solves[2] = {};
  for (const bool told : {false, true}) {
    levels = opened;
    SettleSettings settings;
    settings.rested = told;
    double widest = 0;
    const SettleReport again = settledFrom(levels, widest, settings);
    EXPECT_TRUE(again.settled) << text(again.why);
    EXPECT_LE(again.seamGap, 1e-9);
    EXPECT_EQ(widest, levels.back().cloth.spacing) << "it did not begin anew";
    double moved = 0;
    for (std::size_t k = 0; k < rested.size(); ++k) moved += distance(levels.back().state.position[k], rested[k]);
    EXPECT_LT(moved / static_cast<double>(rested.size()), 0.003) << "nearly all stays where it was";
    solves[told] = again.solves;
  }
  EXPECT_LT(solves[true], solves[false]) << solves[false];
}

// What is too far apart to come together where it stands begins from the coarsest level, as if it were new.
TEST(Settle, ASeamThatStandsFarOpenBeginsAnew) {
  auto levels = tunicLevels();
  mustSettle(levels, tunicBody());
  ClothLevel& finest = levels.back();
  const ClothPiece& front = finest.cloth.pieces[0];
  for (std::uint32_t k = 0; k < front.lattice->nodes.size(); ++k) finest.state.position[front.firstNode + k].z += 0.25;
  double widest = 0;
  const SettleReport again = settledFrom(levels, widest);
  EXPECT_TRUE(again.settled) << text(again.why);
  EXPECT_LE(again.seamGap, 1e-9);
  EXPECT_EQ(widest, levels.front().cloth.spacing);
}

// Two strips that are sewn at their ends and held 60 cm apart, and two that are held through each other so that every
// way to sew is tried: the finest level takes no step, and the report names the seam.
TEST(Settle, WhatNeverClosesIsGivenUpOnACoarseLevel) {
  const Fabric f = *preset("cotton");
  const auto level = [&](std::uint32_t across) {
    ClothLevel made;
    Cloth& cloth = made.cloth;
    const double h = 0.3 / across;
    const std::uint32_t rows = across / 3;
    for (int k = 0; k < 4; ++k) addPiece(cloth, gridLattice(across, rows, h), f);
    made.state = standingBy(cloth, [&](std::size_t piece, Flat p) {
      if (piece < 2) return Vec3{p.u - 0.15, p.v, piece == 0 ? 0.3 : -0.3};
      return piece == 2 ? Vec3{2 + p.u, 0, p.v} : Vec3{2 + p.u, p.v - 0.03, 0.05};
    });
    const std::uint32_t back = cloth.pieces[1].firstNode;
    for (std::uint32_t s = 1; s <= 2; ++s) cloth.seams.push_back(SeamId{s});
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (const std::uint32_t i : {0u, across}) {
        const std::uint32_t node = j * (across + 1) + i;
        cloth.ties.push_back({node, back + node, kNoNode, i == 0 ? 0u : 1u});
      }
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (const std::uint32_t first : {0u, back}) cloth.pinned.push_back(first + j * (across + 1) + across / 2);
    for (std::uint32_t node = cloth.pieces[2].firstNode; node < cloth.nodeCount; ++node) cloth.pinned.push_back(node);
    return made;
  };
  std::vector<ClothLevel> levels{level(9), level(18)};
  const SettleReport report = mustSettle(levels, NoBody());
  EXPECT_FALSE(report.settled);
  EXPECT_GT(report.steps, 0u);
  EXPECT_EQ(report.fineSteps, 0u);
  EXPECT_GT(report.seamGap, 0.1);
  EXPECT_NE(text(report.why).find("stays open by"), std::string::npos) << text(report.why);
}

// What keeps a seam open is told where it is the body.
TEST(Settle, ABodyBetweenTheSidesOfASeamIsNamed) {
  Cloth cloth;
  for (const char* name : {"front", "back"}) {
    addPiece(cloth, gridLattice(2, 2, 0.01), *preset("cotton"));
    cloth.pieces.back().name = name;
  }
  cloth.seams.push_back(SeamId{1});
  cloth.ties.push_back({0, cloth.pieces[1].firstNode, kNoNode, 0});
  const ClothState stands = standingBy(cloth, [](std::size_t piece, Flat p) {
    return Vec3{p.u, 1.4 + p.v, piece == 0 ? 0.07 : -0.07};
  });
  const auto said = [&](const Collider& body) { return text(openSeam(cloth, stands.position, 0.14, body)); };
  EXPECT_THAT(said(CapsuleBody({{{0, 1.4, 0}, {0, 1.5, 0}, 0.05}})),
              testing::AllOf(testing::HasSubstr("“front” and “back” stays open by 140.0 mm about 140 cm above"),
                             testing::HasSubstr("the body is between them")));
  EXPECT_THAT(said(CapsuleBody({{{1, 1.4, 0}, {1, 1.5, 0}, 0.05}})), testing::HasSubstr("bring the pieces nearer"));
}

// No residual is small enough here, as where a node trembles in a sharp fold: the cloth rests once it goes nowhere, and
// not before.
TEST(Settle, ClothThatGoesNowhereIsAtRest) {
  auto strict = tunicLevels();
  SettleSettings settings;
  settings.stopResidual = 1e-12;
  const SettleReport report = mustSettle(strict, tunicBody(), 1, settings);
  EXPECT_TRUE(report.settled) << text(report.why);
  EXPECT_LT(report.residual, 0.4);
  std::vector<ClothLevel> further{strict.back()};
  mustSettle(further, tunicBody());
  const std::vector<Vec3>&still = strict.back().state.position, &rest = further[0].state.position;
  double moved = 0;
  for (std::size_t k = 0; k < still.size(); ++k)
    moved += length(still[k] - rest[k]) / static_cast<double>(still.size());
  EXPECT_LT(moved, 0.002);  // of cells of 33 mm
}

TEST(Settle, RefusesWhatMakesNoSense) {
  Workers workers(1);
  std::vector<ClothLevel> none;
  EXPECT_FALSE(settle(none, NoBody(), {}, Token(), workers));
  ClothLevel level = tunic(6, *preset("cotton"));
  const auto refusedWith = [&](auto spoil) {
    std::vector<ClothLevel> levels{level};
    SettleSettings settings;
    spoil(levels[0], settings);
    const auto report = settle(levels, tunicBody(), settings, Token(), workers);
    return !report && !text(report.error().what).empty();
  };
  EXPECT_TRUE(refusedWith([](ClothLevel& l, SettleSettings&) { l.state.position[3].y = std::nan(""); }));
  EXPECT_TRUE(refusedWith([](ClothLevel& l, SettleSettings&) { l.state.position[3].y = 1e30; }));
  EXPECT_TRUE(refusedWith([](ClothLevel& l, SettleSettings&) { l.state.position.pop_back(); }));
  EXPECT_TRUE(refusedWith([](ClothLevel& l, SettleSettings&) { l.cloth.pieces[0].fabric.weight = -1; }));
  EXPECT_TRUE(refusedWith([](ClothLevel& l, SettleSettings&) { l.cloth.ties[0].a = 1u << 30; }));
  EXPECT_TRUE(refusedWith([](ClothLevel&, SettleSettings& s) { s.gravity.y = std::nan(""); }));
  EXPECT_TRUE(refusedWith([](ClothLevel&, SettleSettings& s) { s.maxSteps = 0; }));
}

}  // namespace
}  // namespace karinui::test
