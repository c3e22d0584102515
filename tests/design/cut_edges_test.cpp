// Where a cut's ends lie, and what the edges along it and beside it are called.
#include <gmock/gmock.h>

#include <algorithm>

#include "design/workroom.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr const char* kPanel =
    "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; shoulder_left L 300 500; neck L 100 500; "
    "shoulder_right L 0 500; armhole L 0 0\"\n";
constexpr const char* kVNeck = "line=\"298.7mm,50cm; 20cm,40cm; 101.2mm,50cm\"";

std::vector<std::string> namesOn(const Document& document, const char* piece) {
  std::vector<std::string> names;
  for (const Edge& edge : document.pieceNamed(piece)->outline.edges) names.push_back(edge.name);
  return names;
}

Document played(const std::string& script) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done done = room.play(file, script);
  EXPECT_TRUE(done) << text(done.error().what);
  return file.document();
}

TEST(CutEdges, EndsNearACornerGoToIt) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const std::string cut = std::string("cut piece=front ") + kVNeck + " name=scrap";
  ASSERT_TRUE(room.play(file, kPanel + cut + "\n"));
  EXPECT_THAT(namesOn(file.document(), "front"), SizeIs(7)) << "no bit of the neck is left";
  EXPECT_THAT(file.log(), HasSubstr("corners=yes"));
  // What an older program recorded leads where it led.
  Context replay = room.context;
  replay.recorded = true;
  const auto kept = apply(played(kPanel), op(cut + " keeps=left"), replay);
  ASSERT_TRUE(kept) << text(kept.error().what);
  EXPECT_THAT(namesOn(*kept, "front"), SizeIs(9));
}

TEST(CutEdges, ARecordedCornerHoldsOnceTheOutlineChanged) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kPanel) + "cut piece=front " + kVNeck + "\n"));
  std::string moved = kPanel;
  moved.replace(moved.find("L 300 500"), 9, "L 299 500");
  ASSERT_TRUE(file.amend(1, op(moved.substr(0, moved.size() - 1)), room.context));
  for (const Edge& edge : file.document().pieceNamed("front")->outline.edges) EXPECT_GT(edge.curve.length(), 0.05);
}

TEST(CutEdges, AreCalledAsIsSaid) {
  const Document cut = played(std::string(kPanel) + "cut piece=front " + kVNeck + " name=scrap edge=neck\n");
  EXPECT_THAT(namesOn(cut, "front"),
              UnorderedElementsAre("hem", "side", "shoulder_left", "neck", "neck_2", "shoulder_right", "armhole"));
  EXPECT_THAT(namesOn(cut, "scrap"), UnorderedElementsAre("neck", "neck_2", "neck_3"));
  const AllowancePlan plan(cut.pattern, cut.allowances);
  EXPECT_EQ(plan.kind(cut.pieceNamed("front")->id, "neck_2"), EdgeKind::Neckline);
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kPanel));
  EXPECT_FALSE(room.play(file, "cut piece=front line=\"-1cm,20cm; 41cm,20cm\" edge=\"two words\"\n"));
  // A slit's banks, and of a symmetric copy the same edges.
  EXPECT_THAT(
      namesOn(played(std::string(kPanel) + "cut piece=front line=\"20cm,-1cm; 20cm,20cm\" edge=vent\n"), "front"),
      Contains("vent_2"));
  const Document both = played(std::string(kPanel) +
                               "mirror piece=front name=other\ncut piece=front line=\"-1cm,20cm; 41cm,20cm\" "
                               "name=low copies=yes edge=join\n");
  std::size_t joins = 0;
  for (const auto& [id, piece] : both.pattern.pieces) joins += piece->outline.find("join").has_value();
  EXPECT_EQ(joins, 4u);
}

TEST(CutEdges, OfACopiedPartAreCalledAsTheWholeOnes) {
  const std::string copy = "duplicate piece=front name=yoke line=\"-1cm,30cm; 41cm,30cm\"";
  const Document now = played(kPanel + copy + " edge=join part=20cm,45cm\n");
  EXPECT_THAT(namesOn(now, "yoke"),
              UnorderedElementsAre("side", "shoulder_left", "neck", "shoulder_right", "armhole", "join"));
  EXPECT_THAT(namesOn(played(kPanel + copy + " named=no part=20cm,45cm\n"), "yoke"), Contains("side_2"));
  // An edge of which it has two bits keeps both of their names.
  EXPECT_THAT(namesOn(played(std::string(kPanel) + "duplicate piece=front name=low part=1cm,1cm "
                                                   "line=\"10cm,-1cm; 20cm,10cm; 30cm,-1cm\"\n"),
                      "low"),
              UnorderedElementsAre("hem", "hem_3", "side", "shoulder_left", "neck", "shoulder_right", "armhole", "cut",
                                   "cut_2"));
  // Its finish goes along under that name.
  const Document wide =
      played(std::string(kPanel) + "allowance edges=front.side width=25mm\n" + copy + " part=20cm,45cm\n");
  EXPECT_DOUBLE_EQ(AllowancePlan(wide.pattern, wide.allowances).width(wide.pieceNamed("yoke")->id, "side"), 0.025);
}

constexpr const char* kHalf =
    "piece name=front_left outline=\"M 0 0; hem L 200 0; side L 200 500; shoulder L 100 500; neck L 0 400; centre L 0 "
    "0\"\npiece name=back outline=\"M 0 0; hem L 400 0; side_right L 400 500; side_left L 0 0\"\nmirror "
    "piece=front_left\n";

TEST(CutEdges, OfBothHalvesTellTheirSideOnceMerged) {
  const std::string merge = "merge a=front_left.centre b=front_right.centre";
  const Document one = played(kHalf + merge + "\n");
  EXPECT_THAT(namesOn(one, "front_left"),
              UnorderedElementsAre("hem_left", "hem_right", "side_left", "side_right", "shoulder_left",
                                   "shoulder_right", "neck_left", "neck_right"));
  EXPECT_THAT(namesOn(played(kHalf + merge + " sides=no\n"), "front_left"), Contains("side_2"));
  // Seams, finishes and formulas know them under their new names.
  const Document sewn = played(std::string(kHalf) +
                               "sew a=front_left.side b=back.side_right name=right\nallowance "
                               "edges=\"front_left.side front_right.side\" width=2cm\nvariable name=long "
                               "value=\"front_left.side + 1cm\"\n" +
                               merge + "\n");
  const Piece& front = *sewn.pieceNamed("front_left");
  const Seam* seam = nullptr;
  for (const auto& [id, own] : sewn.pattern.seams) seam = &own;
  ASSERT_TRUE(seam);
  const auto& side = seam->a.front().piece == front.id ? seam->a : seam->b;
  EXPECT_EQ(side.front().edge, "side_left");
  const AllowancePlan plan(sewn.pattern, sewn.allowances);
  EXPECT_DOUBLE_EQ(plan.width(front.id, "side_left"), 0.02);
  EXPECT_DOUBLE_EQ(plan.width(front.id, "side_right"), 0.02);
  EXPECT_THAT(sewn.variables.at("long"), HasSubstr("side_left"));
  // A record of before keeps the names it had.
  Workroom room;
  Context replay = room.context;
  replay.recorded = true;
  const auto old = apply(played(kHalf), op(merge), replay);
  ASSERT_TRUE(old) << text(old.error().what);
  EXPECT_THAT(namesOn(*old, "front_left"), Contains("side_2"));
}

// A princess line is cut on both halves of a front at once; the side panels are each other's copies.
TEST(CutEdges, OfBothHalvesOfASymmetricPiece) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto play = [&](const std::string& lines) {
    const Done done = room.play(file, lines);
    return done ? std::string() : text(done.error().what);
  };
  ASSERT_EQ(play("body size=eu38\nblock kind=bodice\ncut piece=front line=\"30cm,23cm; 14cm,19cm; 9.5cm,-5cm\" "
                 "name=side_front_left edge=princess symmetric=yes\n"),
            "");
  const Document& document = file.document();
  const Piece *left = document.pieceNamed("side_front_left"), *right = document.pieceNamed("side_front_right");
  ASSERT_TRUE(left && right);
  EXPECT_EQ(right->mirrorOf, left->id);
  EXPECT_NEAR(left->outline.area(), right->outline.area(), 1e-9);
  EXPECT_THAT(namesOn(document, "side_front_left"), Contains("side_left"));
  EXPECT_THAT(namesOn(document, "side_front_right"), Contains("side_right"));
  EXPECT_TRUE(symmetryOf(document.pieceNamed("front")->outline)) << "the middle is still both halves";
  EXPECT_THAT(file.log(), HasSubstr("symmetric=yes"));
  // Seams stay on the edges they were on, of both.
  const auto side = std::find_if(document.pattern.seams.begin(), document.pattern.seams.end(),
                                 [](const auto& seam) { return seam.second.name == "side_right"; });
  ASSERT_NE(side, document.pattern.seams.end());
  EXPECT_EQ(side->second.a.front().piece, right->id);
  // What is done to the one panel is done to the other, and the step plays again as it was.
  ASSERT_EQ(play("line piece=side_front_left along=\"15cm,5cm; 18cm,5cm\" name=pocket\n"), "");
  EXPECT_EQ(file.document().pieceNamed("side_front_right")->lines.size(), 1u);
  DocumentFile again = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(again, file.log()));
  EXPECT_EQ(hash(again.document()), hash(file.document()));
  // Slits too.
  ASSERT_EQ(play("cut piece=back line=\"15cm,-1cm; 15cm,5cm\" symmetric=yes\n"), "");
  EXPECT_TRUE(symmetryOf(file.document().pieceNamed("back")->outline));
  EXPECT_THAT(play("cut piece=back line=\"-40cm,20cm; 40cm,20cm\" symmetric=yes\n"), HasSubstr("crosses the middle"));
  EXPECT_THAT(play("cut piece=side_front_left line=\"15cm,-1cm; 15cm,3cm\" symmetric=yes\n"),
              HasSubstr("is not symmetric"));
  EXPECT_THAT(play("cut piece=side_front_left line=\"15cm,-1cm; 15cm,3cm\" symmetric=yes copies=yes\n"),
              HasSubstr("not both"));
}

// The middle of a symmetric piece is no edge of it.
TEST(CutEdges, ACopiedPartWhoseLineEndsWithinIsToldWhere) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done done =
      room.play(file, std::string(kPanel) + "duplicate piece=front name=yoke line=\"-10mm,40cm; 20cm,30cm\"\n");
  ASSERT_FALSE(done);
  EXPECT_THAT(text(done.error().what), HasSubstr("its end 200.0, 300.0 mm lies within the piece, 200 mm from the"));
}

// What is cut twice is so in all its parts, also of a symmetric copy; a record of before had a new part cut once.
TEST(CutEdges, PartsAreCutAsOftenAsThePiece) {
  for (const bool recorded : {false, true}) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    ASSERT_TRUE(room.play(file, std::string(kPanel) + "quantity piece=front count=2 pairs=yes\n"));
    room.context.recorded = recorded;
    const auto cut =
        apply(file.document(), op("cut piece=front line=\"-50cm,15cm; 50cm,15cm\" name=part"), room.context);
    ASSERT_TRUE(cut) << text(cut.error().what);
    EXPECT_EQ(cut->cutting.at(cut->pieceNamed("front")->id), (Cutting{2, true}));
    const auto part = cut->cutting.find(cut->pieceNamed("part")->id);
    EXPECT_EQ(part == cut->cutting.end() ? Cutting() : part->second, recorded ? Cutting() : (Cutting{2, true}));
  }
}

}  // namespace
}  // namespace karinui
