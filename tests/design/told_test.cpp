// What an operation tells beside doing it names what it means: of many seams and pieces one has to be found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/design/step_words.h"

namespace karinui {
namespace {

using ::testing::AllOf, ::testing::Contains, ::testing::HasSubstr, ::testing::Not;

std::vector<std::string> toldOf(const std::string& script) {
  Workroom room;
  std::vector<std::string> told;
  room.context.advise = [&](const Advice& said) { told.push_back(text(said.what)); };
  DocumentFile file = DocumentFile::inMemory();
  const Done done = room.play(file, script);
  EXPECT_TRUE(done) << text(done.error().what);
  return told;
}

const char* const kTwo =
    "piece name=front outline=\"M 0 0; hem L 400 0; side_left L 400 500; neck L 0 500; side_right L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 400 0; side_right L 400 500; neck L 0 500; side_left L 0 0\" "
    "pose=\"0.4,0,-0.3 y 180deg\"\n";

TEST(Told, ASeamWhoseThreadsCrossIsNamed) {
  EXPECT_THAT(toldOf(std::string(kTwo) + "sew a=front.side_right b=back.side_right reversed=no\n"),
              Contains(AllOf(HasSubstr("threads"), HasSubstr("front.side_right"), HasSubstr("back.side_right"))));
}

// Made as long as the other, it is not told to be longer by nothing.
TEST(Told, ASideThatFitsAgainIsToldToFit) {
  const auto told = toldOf(std::string(kTwo) +
                           "sew a=front.side_left b=back.side_left\nlength edge=front.side_left to=48cm\n"
                           "length edge=front.side_left to=back.side_left\n");
  EXPECT_THAT(told, Contains(HasSubstr("back.side_left is 20.0 mm longer than front.side_left")));
  EXPECT_THAT(told, Contains("front.side_left is as long now as back.side_left, to which it is sewn."));
  EXPECT_THAT(told, Not(Contains(HasSubstr(" 0.0 mm longer"))));
}

// What is declared as ease is no fault; another difference tells of it.
TEST(Told, ALongerSideIsToldBesideItsEase) {
  const std::string sewn = std::string(kTwo) + "sew a=front.side_left b=back.side_left name=side\n";
  EXPECT_THAT(toldOf(sewn + "ease seam=side by=2cm\nlength edge=front.side_left to=52cm\n"),
              Not(Contains(HasSubstr("longer than"))));
  EXPECT_THAT(
      toldOf(sewn + "ease seam=side by=2cm\nlength edge=front.side_left to=55cm\n"),
      Contains("front.side_left is 50.0 mm longer than back.side_left, to which it is sewn. An ease of 20.0 mm is "
               "declared."));
}

// An edge holds as many seams as it has parts; what is left of it is named where one comes too far.
TEST(Told, TheFreePartsOfAnEdgeAreNamed) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kTwo) +
                                  "rectangle name=strap width=10cm height=20cm edges=\"low e1 high e2\"\n"
                                  "sew a=front.hem@0.25:0.5 b=strap.low\n"));
  const auto why = [&](const char* sew) { return text(room.play(file, sew).error().what); };
  EXPECT_THAT(
      why("sew a=front.hem@0.4:0.65 b=strap.high\n"),
      HasSubstr("is already sewn there by seam s4; take that out first, or sew to what is free: front.hem@0:0.25, "
                "front.hem@0.5:1."));
  ASSERT_TRUE(room.play(file, "sew a=front.hem@0.5:0.75 b=strap.high\n"));
  EXPECT_EQ(file.document().pattern.seams.size(), 2u);
  EXPECT_THAT(why("sew a=back.neck b=strap.low\n"),
              HasSubstr("strap.low is already sewn by seam s4; take that out first."));
}

// What was probably meant is offered, under the name of the seam it takes the place of.
TEST(Told, ASeamToTheWrongSideComesWithTheRightOne) {
  Workroom room;
  std::vector<Advice> told;
  room.context.advise = [&](const Advice& said) { told.push_back(said); };
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file,
                        "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 200 500; neck L -200 500; "
                        "side_right L -200 0\"\n"
                        "piece name=back outline=\"M -200 0; hem L 200 0; side_left L 200 500; neck L -200 500; "
                        "side_right L -200 0\" pose=\"0,0,-0.1 y 180deg\"\n"
                        "sew a=front.side_left b=back.side_left name=side\n"));
  ASSERT_EQ(told.size(), 1u);
  ASSERT_TRUE(told.front().mend) << text(told.front().what);
  const std::string mend = text(*told.front().mend);
  EXPECT_THAT(mend, HasSubstr("a=front.side_left b=back.side_right"));
  told.clear();
  ASSERT_TRUE(room.play(file, mend + "\n")) << mend;
  EXPECT_TRUE(told.empty()) << text(told.front().what);
  ASSERT_EQ(file.document().pattern.seams.size(), 1u);
  EXPECT_EQ(file.document().pattern.seams.begin()->second.name, "side");
  EXPECT_EQ(file.document().pattern.seams.begin()->second.b.front().edge, "side_right");
}

TEST(Told, PleatsThatEndInTwoEdgesNameBoth) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done done =
      room.play(file,
                "piece name=skirt outline=\"M 0 0; hem_left L 300 0; side_left L 300 500; waist L -300 500; "
                "side_right L -300 0; hem_right L 0 0\"\npleat edge=skirt.waist depth=2cm\n");
  ASSERT_FALSE(done);
  EXPECT_THAT(text(done.error().what), AllOf(HasSubstr("hem_left, hem_right"), HasSubstr("Join these edges")));
}

TEST(Told, AFacingIsCutBeforeThePleat) {
  const char* const pleated =
      "piece name=skirt outline=\"M 0 0; hem L 600 0; side_left L 600 500; waist L 0 500; side_right L 0 0\"\n";
  EXPECT_THAT(toldOf(std::string(pleated) + "pleat edge=skirt.waist at=0.5 depth=2cm\n"
                                            "facing edges=\"skirt.waist skirt.waist_2\" width=4cm\n"),
              Contains(AllOf(HasSubstr("skirt"), HasSubstr("before the pleat"))));
  EXPECT_THAT(toldOf(std::string(pleated) + "facing edges=skirt.waist width=4cm\n"
                                            "pleat edge=skirt.waist at=0.5 depth=2cm\n"),
              Not(Contains(HasSubstr("before the pleat"))));
}

// Two fronts whose edges meet in the middle and are not sewn: an opening, which a band on all of the run shuts.
const char* const kOpened =
    "piece name=left outline=\"M 0 0; hem L 200 0; side L 200 500; neck L 0 500; centre L 0 0\"\n"
    "piece name=right outline=\"M -200 0; hem L 0 0; centre L 0 500; neck L -200 500; side L -200 0\"\n"
    "piece name=back outline=\"M -200 0; hem L 200 0; side_right L 200 500; neck L -200 500; side_left L -200 0\" "
    "pose=\"0,0,-0.2 y 180deg\"\n"
    "sew a=left.side b=back.side_left\nsew a=right.side b=back.side_right\n";

TEST(Told, ABandOverAnOpeningIsTold) {
  const auto shut = AllOf(HasSubstr("“collar”"), HasSubstr("left.neck"), HasSubstr("right.neck"), HasSubstr("extra="));
  const std::string open = kOpened;
  for (const char* run : {"left.neck right.neck back.neck", "back.neck left.neck right.neck"})
    EXPECT_THAT(toldOf(open + "band name=collar of=\"" + run + "\" depth=4cm sew=yes\n"), Contains(shut)) << run;
  EXPECT_THAT(toldOf(open + "band name=collar of=\"right.neck back.neck left.neck\" depth=4cm sew=yes extra=3cm\n"),
              Not(Contains(shut)));
  EXPECT_THAT(toldOf(open + "sew a=left.centre b=right.centre\nband name=collar of=\"left.neck right.neck back.neck\" "
                            "depth=4cm sew=yes\n"),
              Not(Contains(shut)));
}

// An edge nobody named is said by where it lies; by that alone nobody could write it in a script.
TEST(Told, AnEdgeWithoutANameIsSaidWithWhatScriptsCallIt) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(
      file, "piece name=front outline=\"M 0 0; edge_0 L 400 0; edge_1 L 400 500; edge_2 L 0 500; hem L 0 0\"\n"));
  const auto said = [&](const char* edge) {
    return text(edgeSaid(file.document(), {PieceRef(file.document().pieceNamed("front")->id), edge, 0, 1}));
  };
  EXPECT_THAT(said("edge_1"), AllOf(HasSubstr("side"), HasSubstr("(edge_1)"), HasSubstr("front")));
  EXPECT_THAT(said("hem"), Not(HasSubstr("(")));
}

// A wrap skirt is tied at the side where it ends, not to the other one behind.
TEST(Told, WhatIsFastenedThroughTheBodyIsTold) {
  const auto told = [](const char* side) {
    return toldOf(
        std::string("body size=eu38\nblock kind=skirt\nunsew seam=skirt_side_left\nline piece=skirt_back along=\"") +
        side + "21.5cm,0.5cm; " + side +
        "21.8cm,-3cm\" name=tie\nfasten kind=tie a=skirt_front.side_left@0.94:1 b=skirt_back.tie count=1 "
        "gap=1cm\n");
  };
  const auto through = HasSubstr("what fastens them would run through it");
  EXPECT_THAT(told(""), Contains(through));
  EXPECT_THAT(told("-"), Not(Contains(through)));
}

// What lies across the middle has no other side: its copy would lie in it.
TEST(Told, ACopyThatStandsInItsPieceIsTold) {
  const std::string skirt = "body size=eu38\nblock kind=skirt\n";
  EXPECT_THAT(toldOf(skirt + "mirror piece=skirt_back\n"), Contains(HasSubstr("in the same place")));
  EXPECT_THAT(toldOf(skirt + "rectangle name=pocket width=12cm height=12cm\nmirror piece=pocket\n"),
              Not(Contains(HasSubstr("in the same place"))));
}

// Dungarees whose straps are drawn before the legs are sewn up: the waist behind stands wide, beside the arm.
TEST(Told, AStrapThatBeginsBesideAnArmIsTold) {
  const std::string dungarees =
      "body size=child128\nblock kind=trousers ease=14cm\n"
      "draw name=bib symmetric=yes ease=1cm edges=\"top side low\" line=\"torso:armpit@0; torso:armpit@0.07; "
      "torso:waist@0.14; torso:waist@0\"\n";
  const std::string strap = "strap name=strap_left from=bib.top_left@0.1:0.3 to=leg_back_left.waist@0.1:0.25 width=3cm";
  const auto beside = HasSubstr("beside an arm or a leg");
  const auto undraped = toldOf(dungarees + strap + "\nmirror piece=strap_left\n");
  EXPECT_THAT(undraped, Contains(beside));
  EXPECT_THAT(undraped, Not(Contains(HasSubstr("in the same place")))) << "from side to side, not across the middle";
  EXPECT_THAT(toldOf(dungarees + strap + " over=line:shoulder_left@0.4\n"), Not(Contains(beside)));
}

// A dart takes up cloth of its edge: what that is sewn to is longer by as much now.
TEST(Told, ADartInASewnEdgeTellsWhatTheOtherSideHasToSpare) {
  EXPECT_THAT(toldOf(std::string(kTwo) + "sew a=front.side_left b=back.side_left\n"
                                         "dart edge=front.side_left at=0.5 width=2cm tip=\"25cm,25cm\" symmetric=no\n"),
              Contains(AllOf(HasSubstr("back.side_left is 20.0 mm longer"), HasSubstr("front.side_left"))));
}

// The legs of a dart come the other way round on a symmetric copy; each piece has one dart, and no second.
TEST(Told, TheDartOfASymmetricCopyIsCalledAsThatOfItsPiece) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(
      room.play(file,
                "piece name=front_left outline=\"M 0 0; hem L 300 0; side L 320 400; top L 0 400; centre L 0 0\"\n"
                "mirror piece=front_left\n"
                "dart edge=front_left.side at=0.5 width=2cm tip=\"15cm,20cm\"\n"));
  std::vector<std::string> said;
  for (const auto& [id, seam] : file.document().pattern.seams) said.push_back(text(seamSaid(file.document(), seam)));
  EXPECT_THAT(said, testing::UnorderedElementsAre("dart of left front", "dart of right front"));
}

}  // namespace
}  // namespace karinui
