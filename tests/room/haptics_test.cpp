#include "haptic_cues.h"

#include <gtest/gtest.h>

#include "karinui/body/body.h"
#include "karinui/design/script.h"
#include "recorder.h"

namespace karinui::room {
namespace {

class RoomHaptics : public ::testing::Test {
 protected:
  RoomHaptics() {
    for (const char* line :
         {"body size=jis9ar",
          "draw name=front line=\"torso:waist@0.1; torso:bust@0.1; torso:bust@0.9; torso:waist@0.9\"",
          "draw name=low line=\"torso:hip@0.1; torso:waist-0.2@0.1; torso:waist-0.2@0.9; "
          "torso:hip@0.9\""}) {
      session.perform(*parseOperation(line));
      session.finish();
    }
  }
  Session session;
};

TEST_F(RoomHaptics, ContactIsFeltWhenItBeginsAndTheMoreTheDeeper) {
  const auto met = session.snapshot().body->bvh().first({0.02, 1.45, 2}, {0, 0, -1});
  ASSERT_TRUE(met);
  HapticCues cues;
  PointerSample hover;
  const auto feel = [&](double depth, double seconds) {
    return cues.follow(session, hover, met->point + Vec3{0, 0, -depth}, seconds);
  };
  EXPECT_FALSE(feel(-0.02, 0));
  const auto touched = feel(0.001, 0.01);
  ASSERT_TRUE(touched);
  EXPECT_GE(touched->amplitude, 0.3);
  EXPECT_FALSE(feel(0.002, 0.02));  // not at every picture
  const auto shallow = feel(0.003, 0.2), deep = feel(0.008, 0.4);
  ASSERT_TRUE(shallow && deep);
  EXPECT_GT(deep->amplitude, shallow->amplitude);
  EXPECT_FALSE(feel(-0.02, 0.6));
  EXPECT_FALSE(cues.follow(session, hover, std::nullopt, 0.8));
}

TEST_F(RoomHaptics, TensionGrowsWithThePull) {
  session.command(Command::Pull);
  const auto& front = *session.snapshot().document.pieceNamed("front");
  const Vec3 held = *spaceOf(session.snapshot(), front.id, {0, 0.05});
  HapticCues cues;
  PointerSample sample;
  sample.tip = Rigid{1, 0, 0, 0, held};
  sample.reach = 0.01;
  sample.phase = PointerSample::Phase::Press;
  session.feed(sample);
  cues.follow(session, sample, held, 0);
  double before = 0;
  for (const double pulled : {0.01, 0.02, 0.04}) {
    sample.phase = PointerSample::Phase::Drag;
    sample.tip->carry = held + Vec3{0, 0, pulled};
    session.feed(sample);
    const auto pulse = cues.follow(session, sample, sample.tip->carry, 10 * pulled);
    ASSERT_TRUE(pulse) << pulled;
    EXPECT_GT(pulse->amplitude, before) << pulled;
    before = pulse->amplitude;
  }
}

TEST_F(RoomHaptics, ASnapIsFeltOnce) {
  session.command(Command::Move);
  const auto& low = *session.snapshot().document.pieceNamed("low");
  const Vec3 held = *spaceOf(session.snapshot(), low.id, {0, 0});
  HapticCues cues;
  PointerSample sample;
  sample.tip = Rigid{1, 0, 0, 0, held};
  sample.reach = 0.03;
  sample.phase = PointerSample::Phase::Press;
  session.feed(sample);
  int snaps = 0;
  bool met = false;
  for (int k = 0; k <= 60; ++k) {  // upwards, until its corners meet the other piece's
    sample.phase = PointerSample::Phase::Drag;
    sample.tip->carry = held + Vec3{0, 0.002 * k, 0};
    session.feed(sample);
    met |= !session.preview().space.dots.empty();
    const auto pulse = cues.follow(session, sample, std::nullopt, 0.02 * k);
    snaps += pulse && pulse->amplitude == 0.7;
    if (snaps > 0 && session.preview().space.dots.empty()) break;
  }
  EXPECT_TRUE(met);
  EXPECT_EQ(snaps, 1);
}

TEST_F(RoomHaptics, NoForceIsNoVibrationAndAllOfItTheMost) {
  EXPECT_EQ(amplitudeOf(0, 4), 0);
  EXPECT_EQ(amplitudeOf(4, 4), 1);
  EXPECT_EQ(amplitudeOf(40, 4), 1);
  EXPECT_GT(amplitudeOf(2, 4), amplitudeOf(1, 4));
}

}  // namespace
}  // namespace karinui::room
