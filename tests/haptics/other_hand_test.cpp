// Two devices at once: the one works, the other only leads.
#include "karinui/haptics/other_hand.h"

#include <gtest/gtest.h>

#include "haptics/operations.h"
#include "karinui/devices/pose_source.h"
#include "karinui/haptics/haptic_driver.h"

namespace karinui {
namespace {

// A pose that the test leads, and that tells whether it was ever pushed.
class Led : public PoseSource {
 public:
  Led()
      : PoseSource([] {
          DeviceRecord record = shownRecord("led");
          record.freedomOut = 3;  // as far as anybody knows it could push
          return record;
        }()) {
    place({}, 0);
  }
  void apply(const HandForce& force) override {
    if (!(force == HandForce())) pushed = true;
    PoseSource::apply(force);
  }
  std::atomic<bool> pushed{false};
};

template <class So>
void until(So&& so) {
  for (long k = 0; k < 20'000'000 && !so(); ++k) std::this_thread::yield();
  ASSERT_TRUE(so());
}

TEST(OtherHand, LeadsWhileAButtonIsDownAndIsNeverPushed) {
  auto device = std::make_unique<Led>();
  Led& led = *device;
  OtherHand other(std::move(device), false);
  until([&] { return other.last().hand.ready; });
  EXPECT_EQ(other.takeLed(), Vec3{});
  led.place({1, 0, 0, 0, {0.1, 0, 0}}, 0);
  until([&] { return std::fabs(other.last().hand.tip.carry.x - 0.1) < 1e-6; });
  EXPECT_EQ(other.takeLed(), Vec3{}) << "its button is up";
  double deep = 0;
  for (const std::uint32_t button : {1u, 2u, 4u}) {
    Vec3 sum;
    led.place({1, 0, 0, 0, {0.1, 0, deep -= 0.05}}, button);
    until([&] { return sum += other.takeLed(), sum.z < -0.049; });
    EXPECT_NEAR(sum.z, -0.05, 1e-3) << "metres of the device";
  }
  EXPECT_FALSE(led.pushed);
  EXPECT_EQ(other.last().out, HandForce());
}

// One hand carries a piece and feels it; the other turns meanwhile, and what is carried does not know of it.
TEST(OtherHand, WorksBesideTheMainOne) {
  Session session(cheapSession(std::make_shared<Bodies>()));
  give(session, twoPieces());
  auto device = std::make_unique<Led>();
  Led& led = *device;
  led.place({1, 0, 0, 0, {0.2, 0.25, 0.03}}, 0);
  HapticSettings settings;
  settings.servo.rampSeconds = 0.1;
  settings.servo.latest = settings.servo.stalest = settings.servo.fastest = settings.servo.farthestJump = 1e9;
  settings.longestPause = 1e9;
  settings.realTime = false;
  HapticDriver main(std::move(device), settings);
  auto second = std::make_unique<Led>();
  Led& otherLed = *second;
  OtherHand other(std::move(second), false);
  session.command(Command::Move);
  const auto turn = [&] { main.update(session, {0, 0, 1}), session.update(); };
  until([&] { return turn(), main.last().state == ServoState::Armed; });
  const auto go = [&](Vec3 to, std::uint32_t buttons) {
    led.place({1, 0, 0, 0, to}, buttons);
    until([&] { return turn(), distance(main.last().hand.tip.carry, to) < 1e-6; });
  };
  go({0.2, 0.25, 0.004}, 0);
  go({0.2, 0.25, 0.004}, 1);
  until([&] { return turn(), session.begun(); });
  otherLed.place({1, 0, 0, 0, {0.05, 0, 0}}, 0);
  until([&] { return other.last().hand.tip.carry.x > 0.0499; });
  otherLed.place({1, 0, 0, 0, {0.1, 0, 0}}, 1);
  Vec3 led2;
  until([&] { return turn(), led2 += other.takeLed(), led2.x > 0.049; });
  EXPECT_TRUE(session.begun());
  until([&] { return turn(), main.last().out.force.y < -0.1; });  // its weight
  go({0.23, 0.25, 0.204}, 1);
  led.place({1, 0, 0, 0, {0.23, 0.25, 0.204}}, 0);
  until([&] { return turn(), !session.begun(); });
  session.finish();
  ASSERT_EQ(session.steps().size(), 3u);
  EXPECT_EQ(text(session.steps().back().operation), "move piece=p1 by=30mm,0,200mm");
  EXPECT_FALSE(otherLed.pushed);
}

}  // namespace
}  // namespace karinui
