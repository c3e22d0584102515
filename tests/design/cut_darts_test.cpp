// A cut across darts, and the parts beside one merged: a yoke in one piece.
#include <gmock/gmock.h>

#include "design/workroom.h"
#include "karinui/pattern/darts.h"

namespace karinui {
namespace {

using testing::HasSubstr;

const char* const kDartedSkirt =
    "piece name=skirt outline=\"M 0 0; hem L 500 0; side_left L 480 600; waist L 20 600; side_right L 0 0\"\n"
    "dart edge=skirt.waist at=0.7 width=30mm tip=150mm,480mm name=dart_right symmetric=no\n"
    "dart edge=skirt.waist at=0.3 width=30mm tip=350mm,480mm name=dart_left symmetric=no\n";

TEST(CutDarts, OfASkirtMakeAYokeInOnePiece) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kDartedSkirt));
  const double whole = file.document().pieceNamed("skirt")->outline.area();
  std::vector<Advice> told;
  room.context.advise = [&](const Advice& advice) { told.push_back(advice); };
  ASSERT_TRUE(room.play(file,
                        "pin piece=skirt at=\"40mm,590mm; 250mm,590mm; 250mm,20mm\"\n"
                        "ease seam=s2 by=1mm\ncut piece=skirt line=\"-10mm,530mm; 510mm,530mm\" name=yoke\n"));
  const Document cut = file.document();
  EXPECT_EQ(cut.pattern.pieces.size(), 4u);
  EXPECT_EQ(cut.pattern.seams.size(), 4u);
  for (const char* name : {"yoke", "yoke_2", "yoke_3"}) ASSERT_TRUE(cut.pieceNamed(name)) << name;
  std::size_t pins = 0;
  for (const auto& [piece, places] : cut.pins) pins += places.size();
  EXPECT_EQ(pins, 3u);
  double eased = 0;
  for (const auto& [seam, ease] : cut.eases) eased += ease;
  EXPECT_NEAR(eased, 0.001, 1e-9);
  // What is advised makes the yoke one, with both darts closed.
  std::vector<Operation> mends;
  for (const Advice& advice : told)
    if (advice.mend) mends.push_back(*advice.mend);
  ASSERT_EQ(mends.size(), 2u);
  for (const Operation& mend : mends) EXPECT_THAT(text(mend), HasSubstr("merge a=yoke."));
  for (const Operation& mend : mends) ASSERT_TRUE(room.play(file, text(mend) + "\n"));
  const Document once = file.document();
  EXPECT_EQ(once.pattern.pieces.size(), 2u);
  EXPECT_EQ(dartsOf(once.pattern).size(), 2u) << "the skirt's own stay";
  double area = 0;
  for (const auto& [id, piece] : once.pattern.pieces) area += piece->outline.area();
  EXPECT_NEAR(area, whole, 1e-6);
}

// Also where the part between the darts is a small one, what is advised first leaves the second as it is told.
TEST(CutDarts, AdviceHoldsOneAfterTheOther) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(
      file,
      "piece name=skirt outline=\"M 0 0; hem L 500 0; side_left L 480 600; waist L 20 600; side_right L 0 0\"\n"
      "dart edge=skirt.waist at=0.58 width=30mm tip=220mm,480mm symmetric=no\n"
      "dart edge=skirt.waist at=0.3 width=30mm tip=290mm,480mm symmetric=no\n"));
  std::vector<Operation> mends;
  room.context.advise = [&](const Advice& advice) {
    if (advice.mend) mends.push_back(*advice.mend);
  };
  ASSERT_TRUE(room.play(file, "cut piece=skirt line=\"-10mm,530mm; 510mm,530mm\"\n"));
  ASSERT_EQ(mends.size(), 2u);
  const std::vector<Operation> told = mends;
  for (const Operation& mend : told) {
    const auto done = room.play(file, text(mend) + "\n");
    EXPECT_TRUE(done) << text(mend) << ": " << text(done.error().what);
  }
  EXPECT_EQ(file.document().pattern.pieces.size(), 2u);
}

TEST(CutDarts, WithTwoPointsAtTheWaistGiveEachHalfItsOwn) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(
      room.play(file,
                "piece name=dress outline=\"M 0 0; hem L 500 0; side_left L 480 900; top L 20 900; side_right L 0 0\"\n"
                "double_dart piece=dress from=150mm,700mm to=150mm,400mm width=30mm symmetric=yes\n"
                "cut piece=dress line=\"-10mm,550mm; 510mm,550mm\" name=skirt\n"));
  const Document& now = file.document();
  EXPECT_EQ(now.pattern.pieces.size(), 2u);
  EXPECT_EQ(dartsOf(now.pattern).size(), 4u);
  for (const auto& [id, piece] : now.pattern.pieces) EXPECT_TRUE(piece->holes.empty());
  // Opened, saved as text and played again: the same garment.
  DocumentFile again = DocumentFile::inMemory();
  std::string script;
  for (const auto& step : file.steps()) script += text(step.operation) + "\n";
  Workroom other;
  ASSERT_TRUE(other.play(again, script));
  EXPECT_EQ(hash(again.document()), hash(now));
}

// Which part keeps the piece is recorded: made to another figure, where the other part is the larger, it is the same
// one still, and so are seams and hems.
TEST(Cut, KeepsTheSamePartWhenItsPieceIsMadeOtherwise) {
  const auto script = [](const char* height, const char* cut) {
    return std::string("rectangle name=skirt width=40cm height=") + height + " edges=\"hem right waist left\"\n" +
           "mirror piece=skirt name=other\n" + cut;
  };
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, script("50cm", "cut piece=skirt line=\"-30cm,26cm; 30cm,26cm\" name=yoke copies=yes\n")));
  EXPECT_THAT(text(file.steps().back().operation), HasSubstr("keeps=right"));
  for (const char* name : {"skirt", "other"})
    EXPECT_TRUE(file.document().pieceNamed(name)->outline.find("hem")) << name;
  ASSERT_TRUE(
      file.amend(1, op("rectangle name=skirt width=40cm height=60cm edges=\"hem right waist left\""), room.context));
  for (const char* name : {"skirt", "other"})
    EXPECT_TRUE(file.document().pieceNamed(name)->outline.find("hem")) << name;
  EXPECT_TRUE(file.document().pieceNamed("yoke")->outline.find("waist"));
}

// A line that reached the outline of a small figure's piece may end within a larger one's: told of the cut, not of what
// comes after it and misses the part.
TEST(Cut, ThatDividedIsNoSlitOnALargerPiece) {
  const std::string cut = "cut piece=skirt line=\"-40cm,26cm; 22cm,26cm\" name=yoke\nremove piece=yoke\n";
  const auto skirt = [](const char* width) {
    return std::string("rectangle name=skirt width=") + width + " height=50cm edges=\"hem right waist left\"";
  };
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, skirt("40cm") + "\n" + cut));
  const std::string before = hash(file.document());
  const Done amended = file.amend(1, op(skirt("60cm")), room.context);
  ASSERT_FALSE(amended);
  EXPECT_THAT(text(amended.error().what), HasSubstr("does not cut “skirt” in two here"));
  EXPECT_EQ(hash(file.document()), before);
}

TEST(Cut, IsToldWhichPartKeepsThePiece) {
  const std::string skirt = "rectangle name=skirt width=40cm height=50cm edges=\"hem right waist left\"\n";
  const auto keeps = [&](const std::string& cut, const char* edge) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(file, skirt + cut);
    EXPECT_TRUE(done) << text(done.error().what);
    return done && file.document().pieceNamed("skirt")->outline.find(edge).has_value();
  };
  EXPECT_TRUE(keeps("cut piece=skirt line=\"-30cm,26cm; 30cm,26cm\" keeps=left\n", "waist"));
  EXPECT_TRUE(keeps("cut piece=skirt line=\"-30cm,26cm; 30cm,26cm\" keeps=right\n", "hem"));
  EXPECT_TRUE(keeps("cut piece=skirt line=\"30cm,26cm; -30cm,26cm\" keeps=left\n", "hem"));
  // Of halves alike it is the one left of the line, whichever way the areas are rounded.
  EXPECT_TRUE(keeps("cut piece=skirt line=\"0,60cm; 0,-10cm\"\n", "right"));
  EXPECT_TRUE(keeps("cut piece=skirt line=\"0,-10cm; 0,60cm\"\n", "left"));
}

}  // namespace
}  // namespace karinui
