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
  const auto feel = [&](double depth, double seconds) {
    return cues.follow(session, met->point + Vec3{0, 0, -depth}, seconds);
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
  EXPECT_FALSE(cues.follow(session, std::nullopt, 0.8));
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
  cues.follow(session, held, 0);
  double before = 0;
  for (const double pulled : {0.01, 0.02, 0.04}) {
    sample.phase = PointerSample::Phase::Drag;
    sample.tip->carry = held + Vec3{0, 0, pulled};
    session.feed(sample);
    const auto pulse = cues.follow(session, sample.tip->carry, 10 * pulled);
    ASSERT_TRUE(pulse) << pulled;
    EXPECT_GT(pulse->amplitude, before) << pulled;
    before = pulse->amplitude;
  }
}

// Outline to outline, then corner to corner: each once.
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
  int snaps = 0, met = 0;
  std::size_t before = 0;
  for (int k = 0; k <= 60; ++k) {  // upwards, until its corners meet the other piece's
    sample.phase = PointerSample::Phase::Drag;
    sample.tip->carry = held + Vec3{0, 0.002 * k, 0};
    session.feed(sample);
    const std::size_t snap = session.touchSource().handling.snap;
    met += snap != 0 && snap != before;
    before = snap;
    const auto pulse = cues.follow(session, std::nullopt, 0.02 * k);
    snaps += pulse && pulse->amplitude == 0.7;
    if (snaps > 0 && session.preview().space.dots.empty()) break;
  }
  EXPECT_EQ(met, 2);
  EXPECT_EQ(snaps, met);
}

// The edge that will be sewn is felt when the ray comes to it, dragged to or clicked.
TEST_F(RoomHaptics, AnEdgeThatWillBeSewnIsFelt) {
  const auto middle = [&](const char* piece) {
    const auto& found = *session.snapshot().document.pieceNamed(piece);
    Vec3 best{0, piece == std::string("front") ? 9.0 : -9.0, 0};  // the two edges that face each other
    for (const Edge& edge : found.outline.edges) {
      const auto line = edgeInSpace(session.snapshot(), {PieceRef(found.id), edge.name});
      const Vec3 at = line[line.size() / 2];
      if (piece == std::string("front") ? at.y < best.y : at.y > best.y) best = at;
    }
    return best;
  };
  const Vec3 from = middle("low"), to = middle("front");
  for (const bool dragged : {true, false}) {
    SCOPED_TRACE(dragged);
    session.command(Command::Sew);
    HapticCues cues;
    int snaps = 0;
    double seconds = 0;
    const auto feed = [&](Vec3 at, PointerSample::Phase phase) {
      PointerSample sample;
      sample.ray = {at + Vec3{0, 0, 1}, {0, 0, -1}};
      sample.reach = 0.01;
      sample.phase = phase;
      session.feed(sample);
      const auto pulse = cues.follow(session, std::nullopt, seconds += 0.02);
      snaps += pulse && pulse->amplitude == 0.7;
    };
    feed(from, Phase::Hover);
    feed(from, Phase::Press);
    if (!dragged) feed(from, Phase::Release);
    EXPECT_EQ(snaps, 0);
    for (int k = 1; k <= 20; ++k) feed(lerp(from, to, k / 20.0), dragged ? Phase::Drag : Phase::Hover);
    EXPECT_EQ(snaps, 1);
    session.command(Command::Cancel);
  }
}

TEST_F(RoomHaptics, NoForceIsNoVibrationAndAllOfItTheMost) {
  EXPECT_EQ(amplitudeOf(0, 4), 0);
  EXPECT_EQ(amplitudeOf(4, 4), 1);
  EXPECT_EQ(amplitudeOf(40, 4), 1);
  EXPECT_GT(amplitudeOf(2, 4), amplitudeOf(1, 4));
}

}  // namespace
}  // namespace karinui::room
