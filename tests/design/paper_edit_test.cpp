// Edits of the paper on both halves beside slits, what is told, and records of before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "design/workroom.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// A bodice front of both halves; its axis at u = 0.
constexpr const char* kFrontPaper =
    "piece name=front outline=\"M 0 0; hem_left L 240 0; side_left L 250 340; armhole_left C 170 360 160 460 170 560; "
    "shoulder_left L 70 600; neck_left C 60 540 30 520 0 520; neck_right C -30 520 -60 540 -70 600; shoulder_right L "
    "-170 560; armhole_right C -160 460 -170 360 -250 340; side_right L -240 0; hem_right L 0 0\"\n";
constexpr const char* kBackPaper =
    "piece name=back pose=\"0,0,-0.3 y 180deg\" outline=\"M -240 0; hem L 240 0; side_right L 250 340; top L -250 340; "
    "side_left L -240 0\"\nsew a=front.side_left b=back.side_left name=side\n";

struct Told {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  Told() {
    room.context.advise = [this](const Advice& one) { said += text(one.what) + "\n"; };
  }
  void play(const std::string& script) {
    const Done done = room.play(file, script);
    ASSERT_TRUE(done) << text(done.error().what);
  }
  const Outline& outline() { return file.document().pieceNamed("front")->outline; }
  const Curve& curve(const char* edge) { return outline().edges[*outline().find(edge)].curve; }
};

TEST(PaperEdit, ATypedLengthTellsWhatChanged) {
  Told t;
  t.play(std::string(kFrontPaper) + kBackPaper);
  t.play("length edge=front.side_left to=36cm");
  EXPECT_THAT(t.said, HasSubstr("side_left: 340.1 mm → 360.0 mm on both halves; hem_left keeps 240.0 mm; armhole_left "
                                "keeps"));
  EXPECT_THAT(t.said, HasSubstr("front.side_left is 19.9 mm longer than back.side_left, to which it is sewn."));
  EXPECT_NEAR(t.curve("side_right").length(), 0.36, 1e-9);
  EXPECT_THAT(t.file.log(), HasSubstr("keep=end symmetric=yes"));
}

// A sleeve whose underarm is sewn: its front edge to its back edge.
constexpr const char* kSleevePaper =
    "piece name=sleeve outline=\"M 0 0; hem L 300 0; under_front L 320 300; cap C 220 420 120 420 -20 300; under_back "
    "L 0 "
    "0\"\nsew a=sleeve.under_front b=sleeve.under_back name=underarm\n";

TEST(PaperEdit, ASleevesUnderarmStaysEven) {
  Told t;
  t.play(kSleevePaper);
  t.play("length edge=sleeve.hem to=40cm");
  EXPECT_THAT(t.file.log(), HasSubstr("keep=middle"));
  const Outline& sleeve = t.file.document().pieceNamed("sleeve")->outline;
  EXPECT_NEAR(sleeve.edges[1].curve.length(), sleeve.edges[3].curve.length(), 2e-3);
  // One that left it open when it was recorded is what it was then.
  Told before;
  before.play(kSleevePaper);
  before.room.context.recorded = true;
  const auto then = resolved(before.file.document(), op("length edge=sleeve.hem to=40cm"), before.room.context);
  ASSERT_TRUE(then);
  EXPECT_EQ(std::get<SetLength>(*then).keep, SetLength::Keep::Start);
}

// What stays of an edge that follows a formula is not recorded, so that it is decided alike whenever it is done.
TEST(PaperEdit, ALinkedHemIsReplayed) {
  Told t;
  t.play(std::string(kSleevePaper) + "rectangle name=cuff width=30cm height=6cm\n");
  t.play("length edge=sleeve.hem to=cuff.bottom\nlength edge=cuff.bottom to=34cm");
  Document again;
  t.room.context.recorded = true;
  for (const Step& step : t.file.steps()) {
    auto next = apply(again, step.operation, t.room.context);
    ASSERT_TRUE(next) << text(next.error().what);
    again = *std::move(next);
  }
  EXPECT_EQ(hash(again), hash(t.file.document()));
  EXPECT_NEAR(t.file.document().pieceNamed("sleeve")->outline.edges[0].curve.length(), 0.34, 1e-9);
}

TEST(PaperEdit, ALengthThatIsThereAlreadyIsANote) {
  Told t;
  t.play(kFrontPaper);
  const Outline before = t.outline();
  t.play("length edge=front.hem_left to=24cm");
  EXPECT_EQ(t.said, "Edge hem_left of front is 240.0 mm long already.\n");
  EXPECT_EQ(t.outline(), before);
}

TEST(PaperEdit, LettingOutTellsWhichSeamsFitNoMore) {
  Told t;
  t.play(
      "rectangle name=skirt width=40cm height=60cm edges=\"hem right waist left\"\n"
      "rectangle name=back width=20cm height=60cm edges=\"hem right waist left\"\n"
      "rectangle name=band width=60cm height=4cm\nsew a=skirt.right b=back.left\n"
      "sew a=\"skirt.waist back.waist\" b=band.bottom\n");
  t.said.clear();
  t.play("takein edges=skirt.left by=-4cm partners=no symmetric=no");
  EXPECT_THAT(t.said, HasSubstr("back.waist … skirt.waist is 40.0 mm longer than band.bottom, to which it is sewn."));
  t.said.clear();
  t.play("takein edges=skirt.left by=-2mm partners=no symmetric=no");
  EXPECT_THAT(t.said, testing::Not(HasSubstr("longer"))) << "told already, and it is little";
}

// Points dragged on the paper, or cloth that is pulled, leave what is sewn there as it is.
TEST(PaperEdit, APieceCutAnewTellsWhichSeamsFitNoMore) {
  Told t;
  t.play(std::string(kFrontPaper) + kBackPaper);
  std::string lower = kFrontPaper;
  lower.replace(lower.find("piece name=front"), 16, "reshape piece=front");
  lower.replace(lower.find("250 340"), 7, "250 325");
  lower.replace(lower.find("-250 340"), 8, "-250 325");
  t.play(lower);
  EXPECT_THAT(t.said, HasSubstr("back.side_left is 15.0 mm longer than front.side_left, to which it is sewn."));
  t.said.clear();
  lower.replace(lower.find("250 325"), 7, "250 323");
  lower.replace(lower.find("-250 325"), 8, "-250 323");
  t.play(lower);
  EXPECT_EQ(t.said, "") << "told already, and it is little";
}

TEST(PaperEdit, ASlitOnOneHalfKeepsEditsOnBoth) {
  Told t;
  t.play(kFrontPaper);
  t.play("cut piece=front line=\"12cm,-1cm 12cm,15cm\"");
  t.said.clear();
  // Notches find the undivided hem of the other half by their place.
  t.play("notch edge=front.hem_left_2 at=0.5 symmetric=yes");
  ASSERT_EQ(t.file.document().pieceNamed("front")->marks.size(), 2u);
  EXPECT_EQ(t.file.document().pieceNamed("front")->marks[1].edge, "hem_right");
  t.play("reshape piece=front at=24cm,17cm by=2cm,0,0 within=10cm");
  EXPECT_THAT(t.file.log(), HasSubstr("symmetric=yes outline="));
  EXPECT_NEAR(t.curve("side_left").atFraction(0.5).u, -t.curve("side_right").atFraction(0.5).u, 1e-9);
  t.play("length edge=front.side_left to=36cm");
  EXPECT_NEAR(t.curve("side_right").length(), 0.36, 1e-9);
  EXPECT_THAT(t.said, ::testing::Not(HasSubstr("Only this half")));
  // What has no counterpart is changed alone, and that is told.
  t.play("split edge=front.cut at=0.5");
  EXPECT_THAT(t.said, HasSubstr("Only this half of “front” was changed"));
  const auto forced = t.file.perform(*parseOperation("split edge=front.cut_2 at=0.5 symmetric=yes"), t.room.context);
  ASSERT_FALSE(forced);
  EXPECT_THAT(text(forced.error().what), HasSubstr("because of a slit or dart"));
}

TEST(PaperEdit, ASlitInOneOfTwoLikePiecesSaysThatTheyPartWays) {
  Told t;
  t.play(
      "piece name=sleeve_left outline=\"M 0 0; hem L 300 0; under_front L 320 300; cap L 20 400; under_back L 0 0\"\n"
      "mirror piece=sleeve_left\n");
  t.play("cut piece=sleeve_left line=\"10cm,-1cm 10cm,10cm\"");
  EXPECT_THAT(t.said, HasSubstr("“sleeve_left” and “sleeve_right” are no longer alike"));
}

TEST(PaperEdit, PutAndTakenAwayIsWhatItWasOnBothHalves) {
  Told t;
  t.play(kFrontPaper);
  const Outline before = t.outline();
  t.play("split edge=front.armhole_left at=0.4\njoin edge=front.armhole_left\n");
  ASSERT_EQ(t.outline().edges.size(), before.edges.size());
  for (const char* edge : {"armhole_left", "armhole_right"}) {
    const Curve &now = t.curve(edge), &was = before.edges[*before.find(edge)].curve;
    EXPECT_TRUE(now.between.empty());
    for (const double f : {0.1, 0.3, 0.5, 0.7, 0.9}) EXPECT_LT(distance(now.atFraction(f), was.atFraction(f)), 1e-5);
  }
  // A corner is taken away, also one on the axis: the halves stay images of each other.
  t.play("join edge=front.side_left\njoin edge=front.neck_left\n");
  const auto symmetry = symmetryOf(t.outline());
  ASSERT_TRUE(symmetry);
  EXPECT_EQ(t.outline().edges[*symmetry->partner[*t.outline().find("side_left")]].name, "armhole_right");
}

// To the last bit: a file keeps where each edge ends, and the next one is read as beginning there.
TEST(PaperEdit, WhatIsJoinedAcrossTheAxisMeetsItsNeighbours) {
  Told t;
  t.play("body size=eu38\nblock kind=skirt ease=3cm length=62cm\njoin edge=skirt_back.waist_right_2\n");
  const Outline& outline = t.file.document().pieceNamed("skirt_back")->outline;
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    const Edge &edge = outline.edges[k], &next = outline.edges[(k + 1) % outline.edges.size()];
    EXPECT_EQ(edge.curve.end, next.curve.start) << edge.name;
  }
}

TEST(PaperEdit, ARecordOfBeforeJoinsAsItDid) {
  Told t;
  t.play(kFrontPaper);
  t.play("join edge=p1.side_left symmetric=yes");  // as it was written before `refit`
  EXPECT_THAT(t.file.log(), HasSubstr("join edge=p1.side_left symmetric=yes  #"));
  const Curve old = t.curve("side_left");
  EXPECT_EQ(old.control1, Curve::line({0.24, 0}, {0.25, 0.34}).start +
                              normalized(Flat{0.01, 0.34}) *
                                  ((Curve::line({0.24, 0}, {0.25, 0.34}).length() +
                                    Curve::cubic({0.25, 0.34}, {0.17, 0.36}, {0.16, 0.46}, {0.17, 0.56}).length()) /
                                   3));
  ASSERT_TRUE(t.file.undo(t.room.context));
  t.play("join edge=front.side_left symmetric=yes");
  EXPECT_THAT(t.file.log(), HasSubstr("refit=yes"));
  EXPECT_NE(t.curve("side_left"), old);
}

// An end of a line beside an edge by less than a hand is sure of is on it, in a corner where there is one; what was
// recorded before stays where it was.
TEST(PaperEdit, ALineThatEndsBesideAnEdgeEndsOnIt) {
  constexpr const char* kSquare =
      "piece name=a outline=\"M 0 0; hem L 400 0; left L 400 400; top L 0 400; right L 0 0\" "
      "holes=\"M 180 180; w L 220 180; x L 220 220; y L 180 220; z L 180 180\"\n";
  const auto ends = [&](const std::string& along) {
    Told t;
    t.play(kSquare);
    t.play("line piece=a along=\"" + along + "\" name=l");
    const InternalLine& line = t.file.document().pieceNamed("a")->lines.at(0);
    return std::array{line.curves.front().start, line.curves.back().end};
  };
  for (const char* along : {"0.3mm,200mm; 399.7mm,300mm", "-0.9mm,200mm; 400.9mm,300mm", "0,200mm; 400mm,300mm"}) {
    const auto [start, end] = ends(along);
    EXPECT_LT(distance(start, {0, 0.2}), 1e-12) << along;
    EXPECT_LT(distance(end, {0.4, 0.3}), 1e-12) << along;
  }
  const auto [corner, hole] = ends("0.4mm,0.7mm; 179.4mm,200mm");
  EXPECT_EQ(corner, Flat()) << "into the corner, not beside it";
  EXPECT_LT(distance(hole, {0.18, 0.2}), 1e-12);
  const auto [free, other] = ends("1.2mm,200mm; 100mm,200mm");
  EXPECT_NEAR(free.u, 0.0012, 1e-12) << "that far from the edge it ends within the piece";

  Told t;
  t.play(kSquare);
  const auto refusedFor = [&](const std::string& along) {
    const auto done = t.file.perform(*parseOperation("line piece=a along=\"" + along + "\""), t.room.context);
    return done ? std::string() : text(done.error().what);
  };
  EXPECT_THAT(refusedFor("300mm,300mm; 450mm,300mm"), HasSubstr("leaves a at 40."));
  EXPECT_THAT(refusedFor("100mm,200mm; 300mm,200mm"), HasSubstr("leaves a at 18.")) << "over the hole";
  EXPECT_THAT(refusedFor("0.5mm,300mm; -0.5mm,300mm"), HasSubstr("shorter than 1 mm"));

  t.room.context.recorded = true;
  const auto again = apply(t.file.document(), *parseOperation("line piece=a along=\"0.3mm,200mm; 40cm,30cm\" name=old"),
                           t.room.context);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->pieceNamed("a")->lines.at(0).curves.front().start.u, 0.0003);
}

}  // namespace
}  // namespace karinui
