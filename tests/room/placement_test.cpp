#include "placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "menu_anchor.h"
#include "person.h"

namespace karinui::room {
namespace {

void expectNear(Vec3 a, Vec3 b, double most = 1e-12) {
  EXPECT_LT(distance(a, b), most) << a.x << " " << a.y << " " << a.z;
}

TEST(RoomPlacement, GoesToTheFittingAndBack) {
  const Placement placed{0.3, 0.7, -1.2, {0.4, 0.9, -2}};
  const Vec3 there{0.21, 1.3, -0.17};
  expectNear(placed.roomToFitting(placed.fittingToRoom(there)), there);
  expectNear(placed.roomToStand(placed.standToRoom(there)), there);
  const Rigid pose = test::aimed({0.3, 1, 2}, {0.1, 0.4, 1});
  expectNear(inverseOf(pose)(pose(there)), there);
  // A hand keeps pointing at what it points at.
  const Rigid hand = test::aimed({0.1, 1.2, -0.3}, {0.6, 0.8, -2});
  const Rigid inFitting = placed.roomToFitting(hand);
  const Vec3 ahead = hand.carry + forwardOf(hand) * 0.6;
  expectNear(placed.roomToFitting(ahead), inFitting.carry + forwardOf(inFitting) * (0.6 / 0.3), 1e-9);
}

TEST(RoomPlacement, StandsBeforeThePersonAndFacesThem) {
  const Rigid head = [] {
    Rigid pose = turnAbout({0, 1, 0}, 1.1);
    pose.carry = {2, 1.6, 3};
    return pose;
  }();
  const Placement placed = placedBefore(head, Scale::One, {false, 0.0});
  EXPECT_EQ(placed.foot.y, 0);
  expectNear(placed.foot - Vec3{0, placed.foot.y, 0}, Vec3{2, 0, 3} + turnedAboutUp({0, 0, -1}, 1.1) * 1.1);
  // The body's front, +z, looks at the head.
  const Vec3 front = placed.fittingToRoom({0, 1.6, 1.1});
  expectNear(front, head.carry, 1e-9);
  // Without a known floor it is a person's height below the eyes; for one who sits it is a fitter's height.
  EXPECT_NEAR(placedBefore(head, Scale::One, {false, {}}).foot.y, 0, 1e-12);
  EXPECT_NEAR(placedBefore(head, Scale::One, {true, 0.0}).foot.y, 0.1, 1e-12);
  const Placement desk = placedBefore(head, Scale::TableTop, {false, 0.0});
  EXPECT_EQ(desk.scale, kTableTopScale);
  EXPECT_LT(desk.foot.y, head.carry.y - 0.3);
  EXPECT_LT(desk.fittingToRoom({0, 1.6, 0}).y, head.carry.y + 0.05);
}

TEST(RoomPlacement, LooksStraightDownStillHaveAFront) {
  Rigid down = after(turnAbout({0, 1, 0}, 0.8), turnAbout({1, 0, 0}, -std::numbers::pi / 2));
  EXPECT_NEAR(headingOf(down), 0.8, 1e-9);
}

TEST(RoomGrip, TheToolHandCarriesTheOtherTurns) {
  Placement placed = placedBefore({1, 0, 0, 0, {0, 1.6, 0}}, Scale::One, {false, 0.0});
  const Placement before = placed;
  GrabLocomotion grip;
  const Vec3 hand{0.2, 1.1, -0.4};
  EXPECT_FALSE(grip.follow(placed, {true, hand}, {}));
  EXPECT_TRUE(grip.follow(placed, {true, hand + Vec3{0.1, 0.3, -0.2}}, {}));
  expectNear(placed.foot, before.foot + Vec3{0.1, 0, -0.2});  // the floor keeps its height
  EXPECT_FALSE(grip.follow(placed, {}, {}));
  EXPECT_FALSE(grip.holding());

  // A place the other hand took hold of stays at the hand's side of the body.
  const Vec3 from = placed.foot + Vec3{-0.3, 1, 0.3}, to = placed.foot + Vec3{0.3, 1, 0.3};
  grip.follow(placed, {}, {true, from});
  const Vec3 held = placed.roomToFitting(from);
  EXPECT_TRUE(grip.follow(placed, {}, {true, to}));
  expectNear(placed.fittingToRoom(held), to, 1e-9);
  expectNear(placed.fittingToRoom({}), placed.foot, 1e-9);

  Placement desk = placedBefore({1, 0, 0, 0, {0, 1.6, 0}}, Scale::TableTop, {});
  const double high = desk.foot.y;
  GrabLocomotion other;
  other.follow(desk, {true, hand}, {});
  other.follow(desk, {true, hand + Vec3{0, 0.1, 0}}, {});
  EXPECT_NEAR(desk.foot.y, high + 0.1, 1e-12);
}

TEST(RoomAnchor, FollowsOnlyAHeadThatStaysAway) {
  MenuAnchor anchor;
  Rigid head;
  head.carry = {0, 1.6, 0};
  anchor.follow(head, 0, false);
  Rigid turned = turnAbout({0, 1, 0}, 1.2);
  turned.carry = head.carry;
  anchor.follow(turned, 1, false);
  anchor.follow(turned, 1.5, false);
  EXPECT_EQ(anchor.heading(), 0);  // a glance
  anchor.follow(head, 1.6, false);
  anchor.follow(turned, 2, false);
  anchor.follow(turned, 2.6, false);
  EXPECT_EQ(anchor.heading(), 0);
  anchor.follow(turned, 2.8, true);  // something is under way
  EXPECT_EQ(anchor.heading(), 0);
  anchor.follow(turned, 3, false);
  anchor.follow(turned, 3.8, false);
  EXPECT_NEAR(anchor.heading(), 1.2, 1e-9);
}

}  // namespace
}  // namespace karinui::room
