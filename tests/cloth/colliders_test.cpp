// Several colliders in one drape, each with its own friction. The solver knows nothing of their kinds.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "karinui/cloth/floor.h"

namespace karinui::test {
namespace {

constexpr double kFallingCell = 0.02;
constexpr std::uint32_t kFallingCells = 12;

// A square of cotton; `at` places it.
ClothLevel square(const std::function<Vec3(Flat)>& at, double friction) {
  ClothLevel level;
  Fabric fabric = *preset("cotton");
  fabric.frictionBody = friction;
  addPiece(level.cloth, gridLattice(kFallingCells, kFallingCells, kFallingCell), fabric);
  level.state = standingBy(level.cloth, [&](std::size_t, Flat p) { return at(p); });
  return level;
}

double nearestTo(const Collider& collider, const std::vector<Vec3>& x) {
  double least = 1e9;
  for (Vec3 p : x) least = std::fmin(least, collider.sample(p).distance);
  return least;
}

TEST(Colliders, AClothFallsPastOneOntoTheOther) {
  const CapsuleBody ball({{{0, 0.25, 0}, {0, 0.25, 0}, 0.08}});
  const PlaneBody floor({0, 1, 0}, 0);
  ColliderList colliders;
  colliders.add(ball, 0).add(floor, 0.8);
  const double half = 0.5 * kFallingCells * kFallingCell;
  std::vector<ClothLevel> levels{square([&](Flat p) { return Vec3{p.u - half + 0.12, 0.36, p.v - half}; }, 0.3)};
  bool metBall = false;
  Workers workers(1);
  const auto report = settle(levels, colliders, {}, Token(), workers, [&](const Cloth&, const std::vector<Vec3>& x) {
    metBall = metBall || nearestTo(ball, x) < SettleSettings().skin;
  });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << report->why.pattern;
  EXPECT_TRUE(metBall);
  EXPECT_EQ(report->penetration, 0);
  EXPECT_GE(nearestTo(ball, levels[0].state.position), 0);
  EXPECT_GE(nearestTo(floor, levels[0].state.position), 0);
  EXPECT_LT(middleOf(levels[0].state).y, 0.05) << "it lies on the floor, in folds";
}

// Its height is the floor's, and the thickness of air that every surface keeps.
TEST(Floor, AClothLetFallLiesFlatOnIt) {
  const auto floor = floorCollider();
  const double half = 0.5 * kFallingCells * kFallingCell;
  std::vector<ClothLevel> levels{square([&](Flat p) { return Vec3{p.u - half, 0.03, p.v - half}; }, 0.3)};
  Workers workers(1);
  const auto report = settle(levels, *floor, {}, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << report->why.pattern;
  for (const Vec3& p : levels[0].state.position) {
    EXPECT_NEAR(p.y, SettleSettings().skin, 2e-4);
    EXPECT_LT(std::fmax(std::fabs(p.x), std::fabs(p.z)), half + 1e-3);
  }
}

// An upright cloth that reaches below the floor: a gown that is too long.
TEST(Floor, ClothThatBeginsBelowItIsFoldedOutwardsAtItsFullLength) {
  const double side = kFallingCells * kFallingCell, below = 0.5 * side;
  const auto upright = [&](double z, int layer) {
    ClothLevel level = square([&](Flat p) { return Vec3{p.u - 0.5 * side, p.v - below, z}; }, 0.3);
    level.cloth.pieces[0].layer = layer;
    return level;
  };
  ClothLevel level = upright(0, 0), outer = upright(0, 1);
  const std::vector<Vec3> before = level.state.position;
  layOnFloor(level.cloth, level.state);
  layOnFloor(outer.cloth, outer.state);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec3 p = level.state.position[i];
    if (before[i].y > 0.003) {
      EXPECT_EQ(p, before[i]);
      continue;
    }
    EXPECT_GT(p.y, 0);
    EXPECT_LT(p.y, 0.003);
    EXPECT_NEAR(std::fabs(p.z), p.y - before[i].y, 1e-9) << "as far along the floor as it was below";
    EXPECT_EQ(p.x, before[i].x);
    EXPECT_GT(outer.state.position[i].y, p.y + 0.003) << "an outer layer comes over an inner one";
  }
  for (const std::uint32_t node : {0u, 1u})
    level.cloth.pinned.push_back(kFallingCells * (kFallingCells + 1) + node * kFallingCells);
  std::vector<ClothLevel> levels{level};
  const auto floor = floorCollider();
  Workers workers(1);
  const auto report = settle(levels, *floor, {}, Token(), workers);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled) << report->why.pattern;
  EXPECT_LT(report->strain.mean, 0.01);
  for (const Vec3& p : levels[0].state.position) EXPECT_GT(p.y, 0);
}

TEST(Floor, FrontAndBackAreLaidAwayFromEachOther) {
  ClothLevel both;
  for (int side = 0; side < 2; ++side)
    addPiece(both.cloth, gridLattice(kFallingCells, kFallingCells, kFallingCell),
             *preset("cotton"));  // both look forwards
  both.state = standingBy(both.cloth, [](std::size_t piece, Flat p) {
    return Vec3{p.u, p.v - 0.1, piece == 0 ? 0.15 : -0.15};
  });
  layOnFloor(both.cloth, both.state);
  std::size_t laid = 0;
  for (const Vec3& p : both.state.position) {
    EXPECT_GE(std::fabs(p.z), 0.15 - 1e-12);
    laid += std::fabs(p.z) > 0.2;
  }
  EXPECT_GT(laid, 2 * kFallingCells);
}

TEST(Floor, ClothThatDoesNotComeNearItRestsTheSameToTheBit) {
  const CapsuleBody ball({{{0, 0.25, 0}, {0, 0.25, 0}, 0.08}});
  const auto floor = floorCollider();
  const double half = 0.5 * kFallingCells * kFallingCell;
  const auto rested = [&](const ColliderList& colliders) {
    std::vector<ClothLevel> levels{square([&](Flat p) { return Vec3{p.u - half, 0.34, p.v - half}; }, 0.5)};
    Workers workers(1);
    const auto report = settle(levels, colliders, {}, Token(), workers);
    EXPECT_TRUE(report && report->settled);
    return levels[0].state.position;
  };
  EXPECT_EQ(rested(ball), rested(ColliderList(ball).add(*floor)));
}

// On a slope of 20 degrees cloth slides where friction is below 0.36; at the slope's foot stands a wall.
TEST(Colliders, EachHasFrictionOfItsOwn) {
  const double steep = 20 * M_PI / 180, c = std::cos(steep), s = std::sin(steep);
  const PlaneBody slope({-s, c, 0}, 0), wall({1, 0, 0}, -0.1);  // down the slope is towards the wall
  const auto onSlope = [&](Flat p) { return Vec3{c * p.u, s * p.u, p.v} + Vec3{-s, c, 0} * 0.0012; };
  const auto slidBy = [&](std::optional<double> friction, double fabric) {
    std::vector<ClothLevel> levels{square(onSlope, fabric)};
    const Vec3 before = middleOf(levels[0].state);
    ColliderList colliders;
    colliders.add(slope, friction).add(wall, 0);
    Workers workers(1);
    const auto report = settle(levels, colliders, {}, Token(), workers);
    EXPECT_TRUE(report && report->settled);
    EXPECT_GE(nearestTo(wall, levels[0].state.position), 0);
    EXPECT_GE(nearestTo(slope, levels[0].state.position), 0);
    return length(middleOf(levels[0].state) - before);
  };
  EXPECT_LT(slidBy(0.8, 0), 0.003) << "the slope's own friction holds it";
  EXPECT_GT(slidBy(0.0, 0.8), 0.05) << "and nothing but the wall where it has none";
  EXPECT_LT(slidBy({}, 0.8), 0.003) << "a collider that states none has the fabric's";
}

}  // namespace
}  // namespace karinui::test
