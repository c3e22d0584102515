#include "controller_mapper.h"

#include <gtest/gtest.h>

#include "person.h"

namespace karinui::room {
namespace {

using Phase = PointerSample::Phase;
using Where = PointerSample::Where;

// A wall at z = 0 of the fitting.
struct Wall {
  Placement placed = placedBefore({1, 0, 0, 0, {0, 1.6, 0}}, Scale::One, {false, 0.0});
  PatternTable table;
  double seconds = 0;
  ControllerMapper mapper;
  ControllerState hand;

  ControllerMapper::Mapped step() {
    const ControllerMapper::Around around{
        placed, table, {0, 1.6, 0}, seconds += 0.01, [](const PointerSample& sample) -> std::optional<double> {
          if (sample.tip) {
            const double away = std::fabs(sample.tip->carry.z);
            return away <= sample.reach ? std::optional(away) : std::nullopt;
          }
          const double along = -sample.ray.origin.z / sample.ray.direction.z;
          return along > 0 ? std::optional(along) : std::nullopt;
        }};
    return mapper.follow(hand, PointerSample::Hand::Right, around);
  }
  void aim(Vec3 fromFitting, Vec3 toFitting) {
    hand.tracked = true;
    hand.aim = hand.grip = test::aimed(placed.fittingToRoom(fromFitting), placed.fittingToRoom(toFitting));
  }
};

TEST(RoomMapper, ATriggerThatTremblesIsOnePress) {
  Wall wall;
  wall.aim({0.2, 1.1, 0.9}, {0, 1, 0});
  std::vector<Phase> phases;
  for (const double trigger : {0.0, 0.3, 0.55, 0.62, 0.58, 0.61, 0.45, 0.9, 0.38, 0.5}) {
    wall.hand.trigger = trigger;
    phases.push_back(wall.step().sample->phase);
  }
  const std::vector<Phase> wanted{Phase::Hover, Phase::Hover, Phase::Hover, Phase::Press,   Phase::Drag,
                                  Phase::Drag,  Phase::Drag,  Phase::Drag,  Phase::Release, Phase::Hover};
  EXPECT_EQ(phases, wanted);
}

TEST(RoomMapper, PointsFromAfarAndTouchesNearBy) {
  Wall wall;
  wall.aim({0.2, 1.1, 0.9}, {0, 1, 0});
  auto came = wall.step();
  EXPECT_FALSE(came.sample->tip);
  EXPECT_EQ(came.sample->device, PointerSample::Device::Controller);
  const Vec3 met = came.sample->ray.origin + came.sample->ray.direction * came.along;
  EXPECT_LT(distance(met, {0, 1, 0}), 1e-9);
  wall.aim({0, 1, kTipAhead + 0.01}, {0, 1, 0});
  came = wall.step();
  ASSERT_TRUE(came.sample->tip);
  EXPECT_LT(distance(came.sample->tip->carry, {0, 1, 0.01}), 1e-9);
  // What was begun by touching goes on so, however far the hand goes.
  wall.hand.trigger = 1;
  EXPECT_EQ(wall.step().sample->phase, Phase::Press);
  wall.aim({0.3, 1.3, 0.6}, {0.3, 1.3, 0});
  came = wall.step();
  EXPECT_TRUE(came.sample->tip);
  EXPECT_EQ(came.sample->phase, Phase::Drag);
}

TEST(RoomMapper, TouchingIsAsNearInTheRoomAtAnyScale) {
  Wall wall;
  wall.placed.scale = kTableTopScale;
  wall.aim({0, 1, (kTipAhead + 0.012) / kTableTopScale}, {0, 1, 0});
  const auto came = wall.step();
  EXPECT_TRUE(came.sample->tip);
  EXPECT_NEAR(came.sample->reach, kTouching / kTableTopScale, 1e-12);
}

TEST(RoomMapper, TheTableIsPointedAtAlike) {
  Wall wall;
  const Flat place{0.4, -0.3};
  wall.aim({0.2, 1.3, 0.9}, wall.placed.standToFitting(wall.table.at(place)));
  auto came = wall.step();
  ASSERT_EQ(came.sample->where, Where::Table);
  EXPECT_LT(distance(came.sample->place, place), 1e-9);
  // A drag that leaves the board stays in its plane.
  wall.hand.trigger = 1;
  EXPECT_EQ(wall.step().sample->phase, Phase::Press);
  wall.aim({0.2, 1.3, 0.9}, wall.placed.standToFitting(wall.table.at({2, -0.3})));
  came = wall.step();
  EXPECT_EQ(came.sample->where, Where::Table);
  EXPECT_LT(distance(came.sample->place, {2, -0.3}), 1e-9);
  wall.aim({0.2, 1.3, 0.9}, {0, 2, 0});  // above the horizon
  EXPECT_LT(distance(wall.step().sample->place, {2, -0.3}), 1e-9);
}

TEST(RoomMapper, AHandOutOfSightWaitsAndDropsWhatItLetGoUnseen) {
  Wall wall;
  wall.aim({0.2, 1.1, 0.9}, {0, 1, 0});
  wall.step();
  wall.hand.trigger = 1;
  wall.step();
  wall.hand.tracked = false;
  auto came = wall.step();
  EXPECT_FALSE(came.sample);
  EXPECT_FALSE(came.lost);
  wall.hand.tracked = true;  // still held: goes on
  EXPECT_EQ(wall.step().sample->phase, Phase::Drag);
  wall.hand.tracked = false;
  wall.step();
  wall.hand.tracked = true, wall.hand.trigger = 0;
  came = wall.step();
  EXPECT_TRUE(came.lost);
  EXPECT_FALSE(came.sample);
}

TEST(RoomMapper, ATriggerThatIsStillHeldAfterADropBeginsNothing) {
  Wall wall;
  wall.aim({0.2, 1.1, 0.9}, {0, 1, 0});
  wall.hand.trigger = 1;
  EXPECT_EQ(wall.step().sample->phase, Phase::Press);
  wall.mapper.drop();
  EXPECT_EQ(wall.step().sample->phase, Phase::Hover);
  wall.hand.trigger = 0;
  EXPECT_EQ(wall.step().sample->phase, Phase::Hover);
  wall.hand.trigger = 1;
  EXPECT_EQ(wall.step().sample->phase, Phase::Press);
}

}  // namespace
}  // namespace karinui::room
