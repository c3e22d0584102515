#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

constexpr double kPulledWidth = 0.06, kPulledLength = 0.3, kPulledStretch = 200, kStep = 0.01;

// A strip that hangs from pins along its top; its bottom row is the hand's.
struct PulledStrip {
  explicit PulledStrip(const Fabric& fabric) {
    const std::uint32_t columns = 6, rows = 30;
    addPiece(level.cloth, gridLattice(columns, rows, kStep), fabric);
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, p.v - kPulledLength, 0}; });
    for (std::uint32_t k = 0; k <= columns; ++k) {
      level.cloth.pinned.push_back(rows * (columns + 1) + k);
      grip.nodes.push_back(k);
    }
  }
  Vec3 hem() const { return level.state.position[3]; }
  PullReport pulled(std::vector<Vec3> path) {
    grip.path = std::move(path);
    Workers workers(1);
    auto report = pull(level, NoBody(), grip, {}, Token(), workers);
    KARINUI_ASSERT(report);
    return *report;
  }
  ClothLevel level;
  Grip grip;
};

Fabric light() { return textbook(kPulledStretch, 1e-6, 0.02); }

SettleReport rested(ClothLevel& level, const Collider& body) {
  std::vector<ClothLevel> levels{level};
  Workers workers(1);
  const auto report = settle(levels, body, {}, Token(), workers);
  KARINUI_ASSERT(report);
  level = levels[0];
  return *report;
}

TEST(Pull, FeelsStiffnessTimesWidthTimesStrain) {
  // Downwards and straight sideways from the pins; K w e / L either way.
  for (const Vec3 way : {Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
    PulledStrip strip(light());
    strip.grip.seconds = 5;  // no haste: what the hand feels is the threads, not the strip's swing
    std::vector<Vec3> path{strip.hem()};
    for (double longer : {0.003, 0.006, 0.009, 0.012})
      path.push_back(Vec3{0.03, 0, 0} + way * (kPulledLength + longer));
    const PullReport report = strip.pulled(path);
    EXPECT_TRUE(report.end.settled) << text(report.end.why);
    ASSERT_EQ(report.force.size(), path.size());
    const double right = kPulledStretch * kPulledWidth * 0.012 / kPulledLength;
    EXPECT_NEAR(length(report.force.back()), right, 0.03 * right);
    EXPECT_LT(dot(normalized(report.force.back()), way), -0.999);  // the cloth pulls back
    for (std::size_t k = 1; k < path.size(); ++k) EXPECT_GT(length(report.force[k]), length(report.force[k - 1]));
    EXPECT_GE(report.maxForce, length(report.force.back()));
    EXPECT_LT(distance(strip.hem(), path.back()), 0.0005);
  }
}

TEST(Pull, FeelsNextToNothingWhileSlack) {
  PulledStrip strip(light());
  const PullReport report = strip.pulled({strip.hem(), strip.hem() + Vec3{0, 0.08, 0.05}});
  EXPECT_TRUE(report.end.settled) << text(report.end.why);
  const double weight = 0.02 * kPulledWidth * kPulledLength * 9.81;
  EXPECT_LE(length(report.force.back()), weight);  // the bight hangs from the hand, nothing more
}

TEST(Pull, ClothLetGoHangsAsBefore) {
  PulledStrip strip(light());
  rested(strip.level, NoBody());
  const Vec3 before = middleOf(strip.level.state);
  strip.grip.letGo = true;
  const PullReport report = strip.pulled({strip.hem(), strip.hem() + Vec3{0.02, 0.06, 0.15}});
  EXPECT_TRUE(report.end.settled) << text(report.end.why);
  EXPECT_LT(distance(middleOf(strip.level.state), before), 0.002);
  rested(strip.level, NoBody());
  EXPECT_LT(distance(middleOf(strip.level.state), before), 0.001);
}

TEST(Pull, AHandIsOnlySoStrong) {
  PulledStrip strip(light());
  const PullReport report = strip.pulled({strip.hem(), strip.hem() - Vec3{0, 10, 0}});
  EXPECT_LE(length(report.force.back()), 45);
  EXPECT_GT(length(report.force.back()), 30);
  EXPECT_GT(strip.hem().y, -3);
  EXPECT_NE(text(report.end.why).find("held the hand back"), std::string::npos) << text(report.end.why);
}

// The tunic at rest on its body; the hand takes the hem in front.
ClothLevel restingTunic() {
  std::vector<ClothLevel> levels{tunic(12, *preset("cotton"))};
  Workers workers(1);
  const auto report = settle(levels, tunicBody(), {}, Token(), workers);
  KARINUI_ASSERT(report && report->settled);
  return levels[0];
}

TEST(Pull, HemComesAlongAndFallsBack) {
  for (const bool letGo : {false, true}) {
    ClothLevel level = restingTunic();
    const Vec3 before = middleOf(level.state);
    Grip grip;
    grip.nodes = {5, 6, 7, 18, 19, 20};
    const Vec3 hem = level.state.position[6];
    Vec3 hand;
    for (std::uint32_t node : grip.nodes) hand += level.state.position[node] * (1.0 / 6);
    grip.path = {hand, hand + Vec3{0, 0.05, 0.1}};
    grip.letGo = letGo;
    Workers workers(1);
    const auto report = pull(level, tunicBody(), grip, {}, Token(), workers);
    ASSERT_TRUE(report) << text(report.error().what);
    EXPECT_TRUE(report->end.settled) << text(report->end.why);
    EXPECT_LE(report->end.penetration, 1e-6);
    EXPECT_LE(report->end.seamGap, 1e-9);
    EXPECT_TRUE(check(level.cloth, level.state, nullptr).finite);
    if (!letGo) {
      EXPECT_GT(level.state.position[6].z, hem.z + 0.08) << text(report->end.why);
      rested(level, tunicBody());
    }
    // Friction leaves it any of many rests; it is down and back by more than half.
    EXPECT_LT(distance(middleOf(level.state), before), 0.02);
    EXPECT_LT(distance(level.state.position[6], hem), 0.06);
  }
}

TEST(Pull, StrangePathsNeitherCrashNorTear) {
  const ClothLevel start = restingTunic();
  const Vec3 hem = start.state.position[6];
  const std::vector<std::vector<Vec3>> paths{
      {hem}, {hem, hem}, {hem, hem + Vec3{0, 0, 10}}, {hem, hem - Vec3{0, 0, 0.6}, hem + Vec3{0, 1, 0}}};
  for (const auto& path : paths) {
    ClothLevel level = start;
    Grip grip;
    grip.nodes = {6, 6};
    grip.path = path;
    SettleSettings settings;
    settings.maxSteps = 60;
    Workers workers(1);
    const auto report = pull(level, tunicBody(), grip, settings, Token(), workers);
    ASSERT_TRUE(report) << text(report.error().what);
    EXPECT_EQ(report->force.size(), path.size());
    const ClothCheck found = check(level.cloth, level.state, nullptr);
    EXPECT_TRUE(found.finite);
    EXPECT_LE(report->end.penetration, 0.003);  // cells of 5 cm drawn taut over an arm of 5 cm
    for (Vec3 f : report->force) EXPECT_LT(length(f), 60);
  }
}

TEST(Pull, RefusesWhatMakesNoSense) {
  const ClothLevel start = tunic(6, *preset("cotton"));
  Grip good;
  good.nodes = {3};
  good.path = {start.state.position[3]};
  const auto said = [&](auto spoil) -> std::string {
    ClothLevel level = start;
    Grip grip = good;
    spoil(level, grip);
    const std::vector<Vec3> before = level.state.position;
    Workers workers(1);
    const auto report = pull(level, tunicBody(), grip, {}, Token(), workers);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), level.state.position.begin(),
                           [](Vec3 a, Vec3 b) { return distance(a, b) == 0; }));
    return report ? "" : text(report.error().what);
  };
  const auto names = [](const std::string& sentence, const char* what) {
    return sentence.find(what) != std::string::npos;
  };
  EXPECT_TRUE(names(said([](ClothLevel&, Grip& g) { g.nodes.clear(); }), "no cloth"));
  EXPECT_TRUE(names(said([](ClothLevel&, Grip& g) { g.nodes = {1u << 30}; }), "not there"));
  EXPECT_TRUE(names(said([](ClothLevel& l, Grip&) { l.cloth.pieces[0].live = false; }), "frozen"));
  EXPECT_TRUE(names(said([](ClothLevel& l, Grip&) { l.cloth.pinned = {3}; }), "pin"));
  EXPECT_TRUE(names(said([](ClothLevel&, Grip& g) { g.path.clear(); }), "no path"));
  EXPECT_TRUE(names(said([](ClothLevel&, Grip& g) { g.path.push_back({std::nan(""), 0, 0}); }), "nowhere"));
  EXPECT_TRUE(names(said([](ClothLevel&, Grip& g) { g.path.push_back({1e7, 0, 0}); }), "nowhere"));
  for (double seconds : {0.0, -1.0, 1e9, std::nan("")})
    EXPECT_TRUE(names(said([=](ClothLevel&, Grip& g) { g.seconds = seconds; }), "seconds"));
}

}  // namespace
}  // namespace karinui::test
