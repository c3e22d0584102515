#include <gtest/gtest.h>

#include "karinui/haptics/stylus_pointer.h"
#include "karinui/touch/tick_queue.h"

namespace karinui {
namespace {

using Phase = PointerSample::Phase;

ServoTick tickAt(Vec3 tip, std::uint32_t buttons, double seconds = 0) {
  ServoTick tick;
  tick.seconds = seconds;
  tick.hand.tip.carry = tip;
  tick.hand.buttons = buttons;
  tick.hand.ready = true;
  return tick;
}

TEST(StylusPointer, ButtonsArePhasesAndAPressIsFedWithoutMotion) {
  StylusPointer pointer({1, 4, PointerSample::Hand::Left, 0.02});
  const auto hover = pointer.of(tickAt({1, 2, 3}, 0, 5), {0, 0, 1});
  ASSERT_TRUE(hover);
  EXPECT_EQ(hover->phase, Phase::Hover);
  EXPECT_EQ(hover->device, PointerSample::Device::Stylus);
  EXPECT_EQ(hover->hand, PointerSample::Hand::Left);
  EXPECT_EQ(hover->reach, 0.02);
  EXPECT_EQ(hover->seconds, 5);
  EXPECT_EQ(hover->tip->carry, (Vec3{1, 2, 3}));
  EXPECT_EQ(hover->ray.origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(hover->ray.direction, (Vec3{0, 0, -1}));
  EXPECT_FALSE(pointer.of(tickAt({1, 2, 3}, 0), {0, 0, 1})) << "the hand is still";
  EXPECT_EQ(pointer.of(tickAt({1, 2, 3}, 1), {0, 0, 1})->phase, Phase::Press);
  EXPECT_TRUE(pointer.down());
  EXPECT_EQ(pointer.of(tickAt({1.1, 2, 3}, 1), {0, 0, 1})->phase, Phase::Drag);
  EXPECT_TRUE(pointer.of(tickAt({1.1, 2, 3}, 5), {0, 0, 1})->second);
  EXPECT_EQ(pointer.of(tickAt({1.1, 2, 3}, 0), {0, 0, 1})->phase, Phase::Release);
  EXPECT_FALSE(pointer.down());
}

TEST(StylusPointer, ADragIsThinnedButItsLastPlaceIsFed) {
  StylusPointer pointer;
  pointer.of(tickAt({}, 1), {0, 0, 1});
  int fed = 0;
  for (int k = 1; k <= 19; ++k) fed += pointer.of(tickAt({k * 0.0005, 0, 0}, 1), {0, 0, 1}) ? 1 : 0;
  EXPECT_EQ(fed, 4) << "2 mm apart";
  const auto last = pointer.rest();
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->tip->carry.x, 0.0095, 1e-12);
  EXPECT_FALSE(pointer.rest()) << "once";
}

TEST(StylusPointer, WhileItTouchesItIsWhereTheProxyIs) {
  StylusPointer pointer;
  ServoTick tick = tickAt({0, -0.004, 0}, 0);
  tick.touching = true;
  tick.proxy = {0, 0, 0};
  EXPECT_EQ(pointer.of(tick, {0, 0, 1})->tip->carry, (Vec3{}));
}

TEST(StylusPointer, ADeviceThatIsLostInADragIsToldOnce) {
  StylusPointer pointer;
  pointer.of(tickAt({}, 1), {0, 0, 1});
  EXPECT_FALSE(pointer.takeLost());
  EXPECT_FALSE(pointer.of(ServoTick(), {0, 0, 1}));
  EXPECT_FALSE(pointer.down());
  EXPECT_TRUE(pointer.takeLost());
  EXPECT_FALSE(pointer.takeLost());
  EXPECT_EQ(pointer.of(tickAt({}, 1), {0, 0, 1})->phase, Phase::Hover) << "it is back, its button still down";
  EXPECT_FALSE(pointer.down());
  pointer.of(tickAt({}, 0), {0, 0, 1});
  EXPECT_EQ(pointer.of(tickAt({}, 1), {0, 0, 1})->phase, Phase::Press) << "let go, and pressed anew";
}

// However late the reader comes, no press is lost, and the order is that of the hand.
TEST(TickQueue, KeepsEveryChangeOfAButton) {
  TickQueue queue;
  for (int k = 0; k < 20000; ++k) queue.offer(tickAt({}, 0, k));
  queue.offer(tickAt({}, 1, 20000));
  queue.offer(tickAt({}, 1, 20001));
  queue.offer(tickAt({}, 0, 20002));
  EXPECT_GT(queue.dropped(), 0u);
  std::vector<ServoTick> taken;
  for (ServoTick tick; queue.take(tick);) taken.push_back(tick);
  ASSERT_GE(taken.size(), 3u);
  EXPECT_EQ(taken[taken.size() - 2].seconds, 20000);
  EXPECT_EQ(taken[taken.size() - 2].hand.buttons, 1u);
  EXPECT_EQ(taken.back().seconds, 20002);
  for (std::size_t k = 1; k < taken.size(); ++k) EXPECT_GT(taken[k].seconds, taken[k - 1].seconds);
  // Quite full, the change is kept for when there is room.
  for (int k = 0; k < 3000; ++k) queue.offer(tickAt({}, static_cast<std::uint32_t>(k % 2), k));
  ServoTick tick;
  while (queue.take(tick)) {
  }
  queue.offer(tickAt({}, tick.hand.buttons ^ 1, 4000));
  ASSERT_TRUE(queue.take(tick));
  EXPECT_EQ(tick.seconds, 4000);
}

}  // namespace
}  // namespace karinui
