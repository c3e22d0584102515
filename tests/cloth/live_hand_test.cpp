// The hand that somebody watches: step by step, never to rest.
#include "karinui/cloth/live_hand.h"

#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/check/check.h"

namespace karinui::test {
namespace {

constexpr double kWidth = 0.06, kLength = 0.3, kStretch = 200;

// A strip pinned along its top, the hand at the middle of its hem.
struct HangingStrip {
  explicit HangingStrip(const Fabric& fabric = textbook(kStretch, 1e-6, 0.02)) {
    addPiece(level.cloth, gridLattice(6, 30, 0.01), fabric);
    level.state = standingBy(level.cloth, [](std::size_t, Flat p) { return Vec3{p.u, p.v - kLength, 0}; });
    for (std::uint32_t k = 0; k <= 6; ++k) {
      level.cloth.pinned.push_back(30 * 7 + k);
      grip.nodes.push_back(k);
    }
    grip.path = {hem()};
  }
  Vec3 hem() const { return level.state.position[3]; }
  Result<LiveHand> take() { return LiveHand::take(level, nobody, grip, {}, workers); }
  NoBody nobody;
  Workers workers{1};
  ClothLevel level;
  Grip grip;
};

TEST(LiveHand, LeadsItsPatchAndFeelsStiffnessTimesWidthTimesStrain) {
  HangingStrip strip;
  auto hand = strip.take();
  ASSERT_TRUE(hand) << text(hand.error().what);
  double before = -1;
  Vec3 force;
  for (const double longer : {0.003, 0.006, 0.009, 0.012}) {
    const Vec3 wanted = strip.hem() - Vec3{0, longer, 0};
    for (int k = 0; k < 120; ++k) {  // the swing dies away while the hand stands still
      const auto felt = hand->to(wanted, Token());
      ASSERT_TRUE(felt);
      force = *felt;
    }
    EXPECT_LT(distance(hand->places()[3], wanted), 0.0005);
    EXPECT_GT(length(force), before);
    before = length(force);
  }
  const double right = kStretch * kWidth * 0.012 / kLength;
  EXPECT_NEAR(length(force), right, 0.03 * right);
  EXPECT_GT(normalized(force).y, 0.999);  // the cloth pulls back
  EXPECT_EQ(hand->cloth().nodeCount, strip.level.cloth.nodeCount);
  for (const std::uint32_t k : strip.level.cloth.pinned) EXPECT_EQ(hand->places()[k], strip.level.state.position[k]);
}

// Between two moves the cloth is not stilled: slack, carried aside and held, it swings beyond where it comes to hang
// and back. Of firm cloth, whose bight has no folds that snap.
TEST(LiveHand, KeepsTheSwing) {
  HangingStrip strip(textbook(kStretch, 1e-4, 0.1));
  auto hand = strip.take();
  ASSERT_TRUE(hand);
  const auto middle = [&] {
    Vec3 sum;
    for (const Vec3 p : hand->places()) sum += p * (1.0 / static_cast<double>(hand->places().size()));
    return sum.z;
  };
  Vec3 place = strip.hem();
  for (int k = 0; k < 15; ++k) {
    place += Vec3{0, 0.006, 0.006};
    ASSERT_TRUE(hand->to(place, Token()));
  }
  double farthest = middle();
  for (int k = 0; k < 40; ++k) {
    ASSERT_TRUE(hand->to(place, Token()));
    farthest = std::fmin(farthest, middle());
  }
  EXPECT_GT(middle() - farthest, 0.001);  // stilled at each move it would creep there from one side
}

// A hand that is suddenly elsewhere takes as many steps to get there as the cloth needs to come along.
TEST(LiveHand, LeapsInStepsTheClothCanFollow) {
  HangingStrip strip;
  auto hand = strip.take();
  ASSERT_TRUE(hand);
  const Vec3 place = strip.hem() + Vec3{0, 0.08, 0.04};
  ASSERT_TRUE(hand->to(place, Token()));
  EXPECT_LT(distance(hand->places()[3], place), 0.03);  // of 0.09; the last step's lag
}

// Each call is a step where the way is short, and goes on from where the one before left the cloth: kept velocity,
// kept anchors. Two hands led alike hold the same bits, whatever team works for them.
TEST(LiveHand, GoesOnFromMoveToMoveWithTheSameBits) {
  std::vector<ClothLevel> rested{tunic(12, *preset("cotton"))};
  const CapsuleBody body = tunicBody();
  Workers one(1), two(2);
  ASSERT_TRUE(settle(rested, body, {}, Token(), one));
  Grip grip;
  grip.nodes = {6};
  grip.path = {rested[0].state.position[6]};
  auto a = LiveHand::take(rested[0], body, grip, {}, one);
  auto b = LiveHand::take(rested[0], body, grip, {}, two);
  ASSERT_TRUE(a && b);
  for (int k = 1; k <= 40; ++k) {
    const Vec3 place = grip.path[0] + Vec3{0, 0.02, 0.15} * (k / 40.0);
    const auto left = a->to(place, Token()), right = b->to(place, Token());
    ASSERT_TRUE(left && right);
    EXPECT_EQ(*left, *right);
    EXPECT_LE(length(*left), 40.001);
    ASSERT_EQ(a->places(), b->places()) << k;
  }
  EXPECT_LT(distance(a->places()[6], grip.path[0] + Vec3{0, 0.02, 0.15}), 0.02);
  const ClothCheck found = check(a->cloth(), {a->places()}, nullptr);
  EXPECT_EQ(found.clothClothCrossings, 0u);
  EXPECT_LE(found.seamGap, 1e-9);
  for (const Vec3 p : a->places()) EXPECT_GT(body.sample(p).distance, -0.001);
}

TEST(LiveHand, RefusesWhatMakesNoSenseAndStopsWhenTold) {
  HangingStrip strip;
  auto hand = strip.take();
  ASSERT_TRUE(hand);
  const std::vector<Vec3> before = hand->places();
  for (const Vec3 nowhere : {Vec3{0, std::nan(""), 0}, Vec3{HUGE_VAL, 0, 0}, Vec3{0, 0, 5000}}) {
    EXPECT_FALSE(hand->to(nowhere, Token()));
    EXPECT_EQ(hand->places(), before);
  }
  Token stop;
  stop.cancel();
  const auto felt = hand->to(strip.hem() + Vec3{0, 0, 5}, stop);  // five hundred steps away: not one is taken
  ASSERT_FALSE(felt);
  EXPECT_EQ(felt.error().kind, Error::Kind::Cancelled);
  EXPECT_EQ(hand->places(), before);
  strip.grip.nodes = {30 * 7};
  EXPECT_FALSE(strip.take());  // pinned
  strip.grip.nodes = {};
  EXPECT_FALSE(strip.take());
}

}  // namespace
}  // namespace karinui::test
