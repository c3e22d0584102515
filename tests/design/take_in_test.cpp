// Seams taken in as a tailor pins them: to nothing at their ends, on both sides of the garment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// A front in two copies and a back of both halves, sewn at the sides.
constexpr const char* kBodyPaper =
    "piece name=front_left outline=\"M 0 0; hem L 250 0; side L 240 400; top L 0 400; centre L 0 0\"\n"
    "mirror piece=front_left name=front_right\n"
    "piece name=back outline=\"M 0 0; hem_left L 250 0; side_left L 240 400; top L -240 400; side_right L -250 0; "
    "hem_right L 0 0\"\n"
    "sew a=front_left.side b=back.side_left name=left\nsew a=front_right.side b=back.side_right name=right\n";

struct Pinned {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  Pinned() {
    room.context.advise = [this](const Advice& one) { said += text(one.what) + "\n"; };
  }
  void play(const std::string& script) {
    const Done done = room.play(file, script);
    ASSERT_TRUE(done) << text(done.error().what);
  }
  std::string refusal(const std::string& script) {
    const Done done = room.play(file, script);
    return done ? "" : text(done.error().what);
  }
  const Curve& curve(const char* piece, const char* edge) {
    const Outline& outline = file.document().pieceNamed(piece)->outline;
    return outline.edges[*outline.find(edge)].curve;
  }
  double uneven() {
    double most = 0;
    for (const auto& [id, seam] : file.document().pattern.seams)
      most = std::fmax(most, std::fabs(lengthMismatch(file.document().pattern, seam)));
    return most;
  }
};

// How far a place moved, square to the side.
double wentIn(const Curve& was, const Curve& is, double v) {
  const auto at = [&](const Curve& curve) {
    for (const Flat p : curve.evenly(0, 1, 4000))
      if (std::fabs(p.v - v) < 1e-3 * 0.1) return std::fabs(p.u);
    return 0.0;
  };
  return at(was) - at(is);
}

TEST(TakeIn, AtTheWaistAndToNothingAtHemAndArmhole) {
  Pinned t;
  t.play(kBodyPaper);
  const Curve front = t.curve("front_left", "side"), back = t.curve("back", "side_left");
  t.play("takein edges=front_left.side by=1cm at=0.5");
  EXPECT_EQ(t.curve("front_left", "side").start, front.start);
  EXPECT_EQ(t.curve("front_left", "side").end, front.end);
  EXPECT_NEAR(wentIn(front, t.curve("front_left", "side"), 0.2), 0.010, 1e-4);
  EXPECT_NEAR(wentIn(front, t.curve("front_left", "side"), 0.1), 0.005, 2e-4);
  EXPECT_NEAR(wentIn(back, t.curve("back", "side_left"), 0.2), 0.010, 1e-4);
  EXPECT_EQ(t.curve("back", "side_left").start, back.start);
  // The other side of the garment, the copy's and the half's.
  EXPECT_NEAR(t.curve("front_right", "side").atFraction(0.5).u, -t.curve("front_left", "side").atFraction(0.5).u, 1e-9);
  EXPECT_NEAR(t.curve("back", "side_right").atFraction(0.5).u, -t.curve("back", "side_left").atFraction(0.5).u, 1e-9);
  EXPECT_TRUE(symmetryOf(t.file.document().pieceNamed("back")->outline));
  EXPECT_LT(t.uneven(), 1e-9) << "the seams still fit";
  // Both ways run out along the seam as it was.
  const Flat leaves = normalized(t.curve("front_left", "side").tangent(0));
  EXPECT_NEAR(cross(leaves, normalized(front.tangent(0))), 0, 1e-9);
}

TEST(TakeIn, AtAnEndTheHipIsLetOut) {
  Pinned t;
  t.play(kBodyPaper);
  const Curve front = t.curve("front_left", "side"), back = t.curve("back", "side_left");
  t.play("takein edges=back.side_left by=-1cm at=0");
  EXPECT_EQ(t.curve("back", "side_left").end, back.end);
  EXPECT_NEAR(t.curve("back", "side_left").start.u, back.start.u + 0.01, 2e-4);
  EXPECT_NEAR(t.curve("front_left", "side").start.u, front.start.u + 0.01, 2e-4)
      << "the same end of what it is sewn to";
  EXPECT_EQ(t.curve("front_left", "side").end, front.end);
  EXPECT_EQ(t.curve("back", "hem_left").end, t.curve("back", "side_left").start);
  EXPECT_LT(t.uneven(), 1e-6);
  EXPECT_THAT(t.refusal("takein edges=back.side_left by=1cm at=1.2"), HasSubstr("between 0 and 1"));
}

TEST(TakeIn, WhatIsSewnFromPartsGoesAsTheWhole) {
  Pinned t;
  t.play(std::string(kBodyPaper) + "split edge=front_left.side at=0.25\n");
  const Curve low = t.curve("front_left", "side"), high = t.curve("front_left", "side_2");
  t.play("takein edges=back.side_left by=1cm at=0.5");
  EXPECT_EQ(t.curve("front_left", "side").start, low.start);
  EXPECT_EQ(t.curve("front_left", "side_2").end, high.end);
  EXPECT_NEAR(low.end.u - t.curve("front_left", "side").end.u, 0.005, 2e-4) << "half of it, half-way to the hem";
  EXPECT_EQ(t.curve("front_left", "side").end, t.curve("front_left", "side_2").start);
  EXPECT_NEAR(wentIn(high, t.curve("front_left", "side_2"), 0.2), 0.010, 2e-4);
  EXPECT_LT(t.uneven(), 2e-4);
  // Where the part ends, what it is sewn to goes on: that would be torn.
  EXPECT_THAT(t.refusal("takein edges=front_left.side by=1cm at=1"), HasSubstr("goes on"));
  t.play("takein edges=front_left.side by=1cm at=1 partners=no");
}

TEST(TakeIn, ACornerBetweenTwoEdgesGoesOnce) {
  Pinned t;
  t.play(std::string(kBodyPaper) + "split edge=front_left.side at=0.5\n");
  const Flat was = t.curve("front_left", "side_2").start;
  t.play("takein edges=back.side_left by=1cm");
  EXPECT_NEAR(distance(was, t.curve("front_left", "side_2").start), 0.01, 2e-4);
  EXPECT_LT(t.uneven(), 2e-4);
  // As records of before have it.
  t.play("takein edges=back.side_left by=1cm together=no");
  EXPECT_NEAR(distance(was, t.curve("front_left", "side_2").start), 0.03, 4e-4);
  // Round a corner of the outline the seam line is as far in from both.
  Pinned square;
  square.play(
      "piece name=patch outline=\"M 0 0; a L 200 0; b L 200 200; c L 0 200; d L 0 0\"\n"
      "takein edges=\"patch.a patch.b patch.c patch.d\" by=1cm symmetric=no\n");
  EXPECT_NEAR(square.curve("patch", "a").start.u, 0.01, 1e-9);
  EXPECT_NEAR(square.curve("patch", "a").start.v, 0.01, 1e-9);
  EXPECT_NEAR(square.curve("patch", "c").length(), 0.18, 1e-9);
}

TEST(TakeIn, WhatACopyIsSewnToGoesToo) {
  Pinned t;
  t.play(
      "piece name=sleeve_left outline=\"M 0 0; hem L 240 0; under_front L 300 300; cap L -60 300; under_back L 0 0\"\n"
      "mirror piece=sleeve_left name=sleeve_right\n"
      "rectangle name=cuff_left width=24cm height=5cm\nrectangle name=cuff_right width=24cm height=5cm\n"
      "sew a=sleeve_left.hem b=cuff_left.bottom\nsew a=sleeve_right.hem b=cuff_right.bottom\n");
  t.play("takein edges=sleeve_left.hem by=-1cm");
  EXPECT_NEAR(t.curve("cuff_left", "side_right").length(), 0.06, 1e-9);
  EXPECT_NEAR(t.curve("cuff_right", "side_right").length(), 0.06, 1e-9) << "both cuffs are as deep";
  EXPECT_NEAR(t.curve("sleeve_right", "hem").start.v, -0.01, 1e-9);
  EXPECT_THAT(t.said, HasSubstr("cuff_right.bottom"));
  t.play("takein edges=sleeve_left.hem by=-1cm partners=no");
  EXPECT_NEAR(t.curve("cuff_left", "side_right").length(), 0.06, 1e-9);
  EXPECT_NEAR(t.curve("cuff_right", "side_right").length(), 0.06, 1e-9);
}

TEST(TakeIn, ACurvedEdgeIsLoweredAtOneEnd) {
  Pinned t;
  t.play(
      "piece name=front outline=\"M 0 0; hem_left L 240 0; side_left L 250 340; armhole_left C 170 360 160 460 170 "
      "560; "
      "shoulder_left L 70 600; neck_left C 60 540 30 520 0 520; neck_right C -30 520 -60 540 -70 600; shoulder_right L "
      "-170 560; armhole_right C -160 460 -170 360 -250 340; side_right L -240 0; hem_right L 0 0\"\n");
  const Curve neck = t.curve("front", "neck_left"), right = t.curve("front", "neck_right");
  for (const char* edge : {"neck_left by=1cm at=1", "neck_right by=1cm at=0"}) {
    const Flat middle = t.curve("front", "neck_left").end;
    t.play(std::string("takein edges=front.") + edge);
    EXPECT_EQ(t.curve("front", "neck_left").start, neck.start) << "the shoulder stays";
    EXPECT_EQ(t.curve("front", "neck_right").end, right.end);
    EXPECT_NEAR(t.curve("front", "neck_left").end.u, 0, 1e-12);
    EXPECT_LT(t.curve("front", "neck_left").end.v, middle.v - 0.009);
    EXPECT_NEAR(t.curve("front", "neck_left").atFraction(0.5).u, -t.curve("front", "neck_right").atFraction(0.5).u,
                1e-9);
  }
  EXPECT_TRUE(symmetryOf(t.file.document().pieceNamed("front")->outline));
}

// A sleeve is made longer by its underarm: both its edges, and those of the copy.
TEST(TypedLength, WhatItIsSewnToGetsAsMuchLonger) {
  Pinned t;
  t.play(
      "piece name=sleeve_left outline=\"M 0 0; hem L 240 0; under_front L 300 300; cap C 220 430 20 400 -60 300; "
      "under_back L 0 0\"\nmirror piece=sleeve_left name=sleeve_right\n"
      "sew a=sleeve_left.under_front b=sleeve_left.under_back\n"
      "sew a=sleeve_right.under_front b=sleeve_right.under_back\n");
  const double was = t.curve("sleeve_left", "under_front").length();
  t.play("length edge=sleeve_left.under_front to=33cm keep=end partners=yes");
  for (const char* sleeve : {"sleeve_left", "sleeve_right"})
    for (const char* edge : {"under_front", "under_back"})
      EXPECT_NEAR(t.curve(sleeve, edge).length(), 0.33, 1e-6) << sleeve;
  EXPECT_NEAR(t.curve("sleeve_left", "hem").start.v, t.curve("sleeve_left", "hem").end.v, 2e-3) << "longer all round";
  EXPECT_NEAR(t.curve("sleeve_left", "cap").start.v, 0.3, 1e-9) << "the cap stays";
  EXPECT_THAT(t.said, testing::Not(HasSubstr("longer than")));
  EXPECT_GT(0.33, was);
  t.play("length edge=sleeve_left.under_front to=35cm keep=end");
  EXPECT_NEAR(t.curve("sleeve_left", "under_back").length(), 0.33, 1e-6);
}

// An armhole is made deeper by shorter sides: of front and back, left and right.
TEST(TypedLength, TheSameEndGoesOnBothSidesOfTheSeam) {
  Pinned t;
  t.play(kBodyPaper);
  const Flat hem = t.curve("back", "side_left").start;
  const double was = t.curve("front_left", "side").length();
  t.play("length edge=front_left.side to=38cm keep=start partners=yes");
  EXPECT_EQ(t.curve("back", "side_left").start, hem) << "the hem stays, as at the front";
  EXPECT_NEAR(t.curve("back", "side_left").length(), 0.38, 1e-6);
  EXPECT_NEAR(t.curve("back", "side_right").length(), 0.38, 1e-6);
  EXPECT_NEAR(t.curve("front_right", "side").length(), 0.38, 1e-6);
  EXPECT_LT(t.uneven(), 1e-6);
  EXPECT_GT(was, 0.38);
  EXPECT_TRUE(symmetryOf(t.file.document().pieceNamed("back")->outline));
}

// Both pieces that changed are named: the one that is meant and its symmetric copy, to which it is sewn.
TEST(TakeIn, TellsTheSymmetricCopyToo) {
  Pinned t;
  t.play(std::string(kBodyPaper) + "sew a=front_left.centre b=front_right.centre name=middle\n");
  t.said.clear();
  t.play("takein edges=front_left.centre by=-1cm\n");
  EXPECT_THAT(t.said, HasSubstr("Let out by 10.0 mm: front_left.centre, front_right.centre."));
}

// A flared skirt: the sides lean out by 100 mm over 600 mm.
constexpr const char* kFlared =
    "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 100 600; waist L -100 600; side_right L -200 0\"\n"
    "piece name=back pose=\"0,0,-0.3 y 180deg\" outline=\"M -200 0; hem L 200 0; side_right L 100 600; waist L -100 "
    "600; "
    "side_left L -200 0\"\n"
    "sew a=front.side_left b=back.side_left\nsew a=front.side_right b=back.side_right\n";

TEST(TakeIn, AHemThatIsLetDownGoesDownAlongTheSides) {
  Pinned t;
  t.play(kFlared);
  t.play("notch edge=front.side_left at=0.5\n");
  const Flat notch = t.curve("front", "side_left").atFraction(0.5);
  t.play("takein edges=\"front.hem back.hem\" by=-6cm\n");
  for (const char* piece : {"front", "back"}) {
    const Curve& hem = t.curve(piece, "hem");
    EXPECT_NEAR(hem.start.v, -0.06, 1e-9) << "parallel";
    EXPECT_NEAR(hem.end.v, -0.06, 1e-9);
    EXPECT_NEAR(hem.start.u, -0.21, 1e-9) << "the flare goes on";
    EXPECT_NEAR(hem.end.u, 0.21, 1e-9);
    EXPECT_TRUE(symmetryOf(t.file.document().pieceNamed(piece)->outline));
  }
  EXPECT_LT(t.uneven(), 1e-9);
  const Mark& mark = t.file.document().pieceNamed("front")->marks.front();
  EXPECT_LT(distance(t.curve("front", "side_left").atFraction(mark.fraction), notch), 1e-6)
      << "below the waist as before";
  EXPECT_EQ(std::get<TakeIn>(t.file.steps().back().operation).follow, Choice::Yes) << "recorded as decided";
  // Taken up again it is as it was, and further still on the sides.
  t.play("takein edges=\"front.hem back.hem\" by=6cm\n");
  EXPECT_NEAR(t.curve("front", "hem").start.u, -0.2, 1e-9);
  EXPECT_NEAR(t.curve("front", "hem").start.v, 0, 1e-9);
  t.play("takein edges=\"front.hem back.hem\" by=12cm\n");
  EXPECT_NEAR(t.curve("front", "hem").end.u, 0.18, 1e-9);
  EXPECT_NEAR(t.curve("front", "hem").end.v, 0.12, 1e-9);
}

TEST(TakeIn, TheHemOfARingStaysRound) {
  Pinned t;
  t.play("ring name=skirt inner=60cm depth=50cm angle=120deg\n");
  const Curve was = t.curve("skirt", "hem");
  ASSERT_EQ(was.kind, Curve::Kind::Arc);
  const double radius = was.length() / (2.0 / 3 * std::numbers::pi);
  t.play("takein edges=skirt.hem by=-4cm\n");
  const Curve is = t.curve("skirt", "hem");
  EXPECT_EQ(is.kind, Curve::Kind::Arc);
  EXPECT_NEAR(is.length(), was.length() * (radius + 0.04) / radius, 1e-7) << "4 cm longer everywhere";
  t.play("takein edges=skirt.hem by=10cm\n");
  EXPECT_NEAR(t.curve("skirt", "hem").length(), was.length() * (radius - 0.06) / radius, 1e-7);
}

// A hip's curve above, a hem of two halves that curve up to the sides, and a fold in the middle.
constexpr const char* kCurved =
    "piece name=back outline=\"M 0 0; hem_left C 100 0 180 8 250 20; side_left C 235 200 240 380 200 500; waist L 0 "
    "490; "
    "fold L 0 0\"\n";

TEST(TakeIn, ACurvedSideGoesOnStraightAndACurvedHemStaysParallel) {
  for (const double by : {-0.05, 0.05}) {
    Pinned t;
    t.play(kCurved);
    const Curve side = t.curve("back", "side_left"), hem = t.curve("back", "hem_left");
    t.play("takein edges=back.hem_left by=" + std::to_string(by) + "m\n");
    const Curve now = t.curve("back", "side_left"), low = t.curve("back", "hem_left");
    EXPECT_NEAR(low.start.u, 0, 1e-9) << "down the fold";
    EXPECT_NEAR(low.start.v, by, 1e-6);
    for (int k = 1; k < 20; ++k) {
      const Flat place = low.atFraction(k / 20.0);
      double nearest = 1;
      const auto old = hem.flattened(1e-7);
      for (std::size_t i = 0; i + 1 < old.size(); ++i)
        nearest = std::fmin(nearest, distanceToSegment(old[i], old[i + 1], place));
      if (k < 18) {
        EXPECT_NEAR(nearest, 0.05, 1e-4) << k;
      }
    }
    // What is above the old hem, or the new one, is the side as it was.
    const double shared = std::fmin(side.length(), now.length()) - 1e-3;
    const Curve a = side.reversed(), b = now.reversed();
    for (const double s : {0.1, 0.5, 0.9})
      EXPECT_LT(distance(a.at(a.parameterAt(s * shared)), b.at(b.parameterAt(s * shared))), 2e-6);
    if (by < 0) {
      EXPECT_NEAR(cross(normalized(endTangent(side, false)), normalized(side.start - low.end)), 0, 1e-6)
          << "straight on";
    }
  }
}

TEST(TakeIn, AHemThatIsToGoStraightDownOrWasRecordedSoDoes) {
  Pinned t;
  t.play(kFlared);
  t.play("takein edges=front.hem by=-6cm follow=no\n");
  EXPECT_NEAR(t.curve("front", "hem").start.u, -0.2, 1e-9);
  Operation old = t.file.steps().back().operation;
  std::get<TakeIn>(old).follow = Choice::Auto;
  Context again = t.room.context;
  again.recorded = true;
  const auto after = apply(t.file.document(), old, again);
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->pieceNamed("front")->outline.edges.front().curve.start.u, -0.2, 1e-9);
  EXPECT_EQ(std::get<TakeIn>(asRecorded(old)).follow, Choice::No);
  EXPECT_THAT(t.refusal("takein edges=front.hem by=-1cm at=0.5 follow=yes\n"), HasSubstr("all along"));
  // Another edge goes square to itself, unless it is said.
  t.play("takein edges=back.waist by=-1cm\n");
  EXPECT_NEAR(t.curve("back", "waist").length(), 0.2, 1e-9);
}

}  // namespace
}  // namespace karinui
