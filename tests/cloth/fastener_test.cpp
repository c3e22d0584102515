// Buttons and zips against what hangs from them.
#include "cloth/fastener.h"

#include <gtest/gtest.h>

#include <numeric>

#include "cloth/edge_bending.h"
#include "cloth/helpers.h"
#include "karinui/check/check.h"
#include "karinui/cloth/pulls.h"

namespace karinui::test {
namespace {

constexpr double kWide = 0.2, kHigh = 0.12, kLap = 0.03;
constexpr Vec3 kDown{0, -9.81, 0};

Fastening closing(FasteningKind kind) {
  Fastening own;
  own.kind = kind;
  own.a = {{{1}, "bottom", 0, 1}}, own.b = {{{2}, "top", 0, 1}};
  if (kind == FasteningKind::Zip) {
    own.at = {0, 1};
  } else {
    own.at = {0.25, 0.75}, own.closed = 2;
    if (kind == FasteningKind::Button) own.inset = kLap / 2;
  }
  return own;
}

// One piece that is pinned along its top, and another that hangs from its lower edge by what closes the two.
struct Hung {
  ClothLevel level;
  double weight = 0;  // N, of the lower piece and of the allowances on both sides of a zip
};
// `lap`: by how much they lie over each other at first; `off`: how far the upper one stands before the other; metres.
Hung hung(const Fastening& own, double lap, double off) {
  Allowances finish;
  finish.fastenings["closing"] = own;
  Pattern pattern = withZips(patternOf({rectangle(1, kWide, kHigh), rectangle(2, kWide, kHigh)}), finish.fastenings);
  ClothChoice choice;
  choice.finish = &finish;
  for (int k = 0; k <= 20; ++k) choice.pins[{1}].push_back({kWide * k / 20, kHigh});
  Hung made{levelOf(pattern, 0.01, *preset("denim"), choice), 0};
  made.level.state = standingBy(made.level.cloth, [&](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u, p.v, off} : Vec3{p.u, p.v - kHigh + lap, 0};
  });
  double mass = made.level.cloth.pieces[1].fabric.weight * kWide * kHigh;
  for (const auto& [node, more] : edgeMasses(made.level.cloth)) mass += more;
  made.weight = mass * length(kDown);
  return made;
}

Hung hung(const Fastening& own) { return hung(own, own.kind == FasteningKind::Button ? kLap : 0, 0.004); }

double pullOf(const Hung& made) {
  const auto pulls = fasteningPulls(made.level.cloth, made.level.state);
  return std::accumulate(pulls.begin(), pulls.end(), 0.0, [](double sum, const auto& p) { return sum + p.force; });
}

Hung atRest(Hung made) {
  Workers workers;
  std::vector<ClothLevel> levels{made.level};
  SettleSettings settings;
  settings.gravity = kDown;
  const auto report = settle(levels, CapsuleBody({}), settings, {}, workers);
  EXPECT_TRUE(report && report->settled) << (report ? text(report->why) : text(report.error().what));
  made.level = levels.back();
  return made;
}

Hung atRest(const Fastening& own) { return atRest(hung(own)); }

// Together they bear the weight of what hangs from them, and none is drawn out by a millimetre more than its slack.
TEST(Fastener, BearsWhatHangsFromIt) {
  for (const FasteningKind kind : {FasteningKind::Button, FasteningKind::Hook, FasteningKind::Zip}) {
    const Hung made = atRest(closing(kind));
    EXPECT_NEAR(pullOf(made), made.weight, 0.12 * made.weight) << static_cast<int>(kind);
    const auto pulls = fasteningPulls(made.level.cloth, made.level.state);
    EXPECT_EQ(pulls.size(), kind == FasteningKind::Zip ? 1u : 2u);
    for (const FasteningPull& pull : pulls) {
      EXPECT_TRUE(pull.holds());
      EXPECT_LT(pull.gap, 0.0045);
    }
  }
}

// What is buttoned over stays over: off the right side of the other, all along the lap.
TEST(Fastener, TheLapStaysOver) {
  const Hung made = atRest(closing(FasteningKind::Button));
  double over = 1, under = -1;
  for (std::size_t k = 0; k < made.level.cloth.nodeCount; ++k) {
    const Vec3 p = made.level.state.position[k];
    const bool first = k < made.level.cloth.pieces[1].firstNode;
    if (first && p.y < kLap / 2) over = std::fmin(over, p.z);
    if (!first && p.y > kLap / 2) under = std::fmax(under, p.z);
  }
  EXPECT_GT(over, under);
  EXPECT_EQ(check(made.level.cloth, made.level.state, nullptr).clothClothCrossings, 0u);
}

// Ends that lie in one plane are drawn off it where they are to lap, the upper one to the right side of the other; a
// hook at their edges draws them straight together.
TEST(Fastener, LeadsTheLapOver) {
  Workers workers(1);
  const auto lifted = [&](FasteningKind kind, double inset) {  // share of the upper one's pull
    Fastening own = closing(kind);
    own.inset = inset;
    const Hung made = hung(own, -0.01, 0);
    FastenerContact contact(made.level.cloth, 0.002);
    contact.detect({made.level.state.position}, workers);
    std::vector<Vec3> gradient(made.level.cloth.nodeCount);
    contact.addGradient(gradient);
    Vec3 upper;
    for (std::size_t k = 0; k < made.level.cloth.pieces[1].firstNode; ++k) upper -= gradient[k];
    return normalized(upper).z;
  };
  // The places are 4 cm apart, so they are led together 0.3 of that off.
  for (const FasteningKind kind : {FasteningKind::Button, FasteningKind::Hook})
    EXPECT_NEAR(lifted(kind, kLap / 2), std::sin(std::atan(0.3)), 1e-9) << static_cast<int>(kind);
  EXPECT_EQ(lifted(FasteningKind::Hook, 0), 0);
}

// A tie holds nothing while its places are nearer than its gap; any force is the same on both sides, turned round.
TEST(Fastener, ATiePullsFromItsGapOn) {
  Workers workers(1);
  Fastening own = closing(FasteningKind::Tie);
  own.gap = 0.05;
  Hung made = hung(own);
  const auto move = [&](double down) {
    ClothState state = made.level.state;
    for (std::size_t k = made.level.cloth.pieces[1].firstNode; k < state.position.size(); ++k)
      state.position[k].y -= down;
    return state;
  };
  for (Vec3& p : made.level.state.position) p.z = 0;
  for (const FasteningPull& pull : fasteningPulls(made.level.cloth, move(0.049))) EXPECT_EQ(pull.force, 0);
  const ClothState drawn = move(0.052);
  for (const FasteningPull& pull : fasteningPulls(made.level.cloth, drawn)) EXPECT_NEAR(pull.force, 2000 * 0.002, 1e-9);
  FastenerContact contact(made.level.cloth, 0.002);
  contact.detect({drawn.position}, workers);
  std::vector<Vec3> gradient(made.level.cloth.nodeCount);
  contact.addGradient(gradient);
  Vec3 upper, lower;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    (k < made.level.cloth.pieces[1].firstNode ? upper : lower) += gradient[k];
  EXPECT_LT(distance(upper, {0, 8, 0}), 1e-9);
  EXPECT_LT(distance(upper, -lower), 1e-12);
}

// Beyond what a thread bears it pulls no harder, and says that it does not close.
TEST(Fastener, SaysWhenItDoesNotClose) {
  Hung made = hung(closing(FasteningKind::Hook));
  for (std::size_t k = made.level.cloth.pieces[1].firstNode; k < made.level.state.position.size(); ++k)
    made.level.state.position[k].y -= 0.3;
  for (const FasteningPull& pull : fasteningPulls(made.level.cloth, made.level.state)) {
    EXPECT_EQ(pull.force, 60);
    EXPECT_FALSE(pull.holds());
    EXPECT_NEAR(pull.gap, 0.3, 0.001);
  }
  Fastening open = closing(FasteningKind::Hook);
  open.closed = 0;
  EXPECT_TRUE(fasteningPulls(hung(open).level.cloth, hung(open).level.state).empty());
}

}  // namespace
}  // namespace karinui::test
