// A facing lies within what it faces, wrong side to wrong side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "karinui/design/lay_plan.h"
#include "karinui/design/piece_label.h"
#include "karinui/pattern/facing.h"

namespace karinui {
namespace {

// Faced at the waist, and at rest again.
TEST(FacedEdges, LieWithinTheSkirt) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played =
      drapingRoom().play(file, std::string(kSkirt) + "facing edges=\"front.waist back.waist\" width=9cm\ndrape\n");
  ASSERT_TRUE(played) << text(played.error().what);
  const Document& document = file.document();
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("front"), &facing = *document.pieceNamed("front_facing");
  EXPECT_EQ(facing.layer, front.layer - 1);
  for (const double f : {0.2, 0.5, 0.8})
    expectWithin(document, facing, front, findEdge(facing, "inner")->curve.atFraction(f));
}

// Over darts a facing is one piece, whose paper is as long as the waist is with its darts closed; its sides stay sewn
// to the facing beside. Told not to, or as a record of before, it is in parts.
TEST(FacedEdges, GoOnOverClosedDarts) {
  const std::string skirt =
      "piece name=front outline=\"M -250 0; hem L 250 0; side_left L 240 500; waist L -240 500; side_right L -250 0\"\n"
      "dart edge=front.waist at=0.3 tip=9cm,38cm width=3cm\n"
      "piece name=back outline=\"M -250 0; hem L 250 0; side_left L 240 500; waist L -240 500; side_right L -250 0\" "
      "pose=\"0,0,-0.3 y 180deg\"\n"
      "sew a=front.side_left b=back.side_right\nsew a=front.side_right b=back.side_left\n";
  const std::string faced = "facing edges=\"front.waist* back.waist\" width=5cm";
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done played = room.play(file, skirt);
  ASSERT_TRUE(played) << text(played.error().what);
  const auto facings = [](const Document& document) {
    std::map<std::string, double> waists;
    for (const auto& [id, piece] : document.pattern.pieces)
      if (piece->name.find("facing") != std::string::npos)
        for (const Edge& edge : piece->outline.edges)
          if (edge.name.starts_with("waist")) waists[piece->name] += edge.curve.length();
    return waists;
  };
  using testing::DoubleNear, testing::ElementsAre, testing::Pair;
  const auto one = apply(file.document(), op(faced), room.context);
  ASSERT_TRUE(one) << text(one.error().what);
  EXPECT_THAT(facings(*one),
              ElementsAre(Pair("back_facing", DoubleNear(0.48, 1e-6)), Pair("front_facing", DoubleNear(0.42, 5e-4))));
  const Piece& facing = *one->pieceNamed("front_facing");
  EXPECT_EQ(facing.grain, one->pieceNamed("front")->grain);
  std::size_t across = 0, on = 0;
  for (const auto& [id, seam] : one->pattern.seams) {
    const auto holds = [&](const std::vector<EdgeSpan>& side, const char* name) {
      return side.front().piece == one->pieceNamed(name)->id;
    };
    across += (holds(seam.a, "front_facing") && holds(seam.b, "back_facing")) ||
              (holds(seam.b, "front_facing") && holds(seam.a, "back_facing"));
    on += holds(seam.b, "front_facing") && seam.tie == Seam::Tie::Pleat;
  }
  EXPECT_EQ(across, 2u);
  EXPECT_EQ(on, 3u);
  const auto parts = apply(file.document(), op(faced + " closed=no"), room.context);
  ASSERT_TRUE(parts);
  EXPECT_EQ(facings(*parts).size(), 4u);
  room.context.recorded = true;
  const auto old = apply(file.document(), op(faced), room.context);
  ASSERT_TRUE(old);
  EXPECT_EQ(facings(*old).size(), 4u);
}

// A front is faced with its copy in one step; the facings are each other's copies. Without a copy that is refused.
TEST(FacedEdges, OnSymmetricCopiesToo) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(
      file,
      "piece name=front_left outline=\"M 0 0; hem L 300 0; side_left L 320 500; neck L 20 450; centre L 0 0\"\n"
      "piece name=back outline=\"M 0 0; hem L 300 0; side L 300 500; neck L 0 450; centre L 0 0\" pose=\"0,0,-0.3\"\n"
      "mirror piece=front_left\n"));
  const auto faced = [&](const char* line) { return apply(file.document(), op(line), room.context); };
  const auto both = faced("facing edges=\"front_left.neck front_left.centre\" width=5cm copies=yes");
  ASSERT_TRUE(both) << text(both.error().what);
  const Piece *left = both->pieceNamed("front_left_facing"), *right = both->pieceNamed("front_right_facing");
  ASSERT_TRUE(left && right);
  EXPECT_EQ(right->mirrorOf, left->id);
  EXPECT_NEAR(left->outline.area(), right->outline.area(), 1e-9);
  EXPECT_EQ(both->pattern.seams.size(), 2u);
  const auto named = faced("facing edges=\"front_left.neck front_right.neck\" copies=yes");
  ASSERT_TRUE(named) << text(named.error().what);
  EXPECT_EQ(named->pattern.seams.size(), 2u) << "each once";
  EXPECT_EQ(faced("facing edges=front_left.neck")->pattern.seams.size(), 1u);
  const auto none = faced("facing edges=back.neck copies=yes");
  ASSERT_FALSE(none);
  EXPECT_THAT(text(none.error().what), testing::HasSubstr("has no symmetric copy"));
}

// Two slanted panels and a straight one, whose middle one's lining is sewn to nothing but linings.
const char* const kPanels =
    "piece name=first outline=\"M 0 0; hem L 200 0; side L 200 300; top L 60 300; free L 0 0\"\n"
    "piece name=second outline=\"M 0 0; hem L 200 0; far L 150 300; top L 0 300; side L 0 0\" pose=\"1,0,0\"\n"
    "piece name=third outline=\"M 0 0; hem L 200 0; free L 200 300; top L 0 300; side L 0 0\" pose=\"2,0,0\"\n"
    "sew a=first.side b=second.side\nsew a=second.far b=third.side\n";

// Lay the paper of the outer piece on its lining: the lining's paper shows the cloth's wrong side. Where its mirror
// image is another shape, it is cut with the paper turned over, and the paper says so.
TEST(FacedEdges, AndLiningsAreCutFaceDown) {
  Workroom room;
  const auto played = [&](const std::string& script) {
    DocumentFile file = DocumentFile::inMemory();
    const auto done = room.play(file, kPanels + script);
    EXPECT_TRUE(done) << text(done.error().what);
    return file.document();
  };
  const auto named = [](const Document& document, const std::set<PieceId>& ids) {
    std::vector<std::string> names;
    for (const PieceId id : ids) names.push_back(document.find(id)->name);
    return names;
  };
  const auto down = [&](const Document& document) {
    return named(document,
                 cutFaceDown(document.pattern, AllowancePlan(document.pattern, document.allowances), document.cutting));
  };
  using testing::UnorderedElementsAre;
  EXPECT_THAT(down(played("")), testing::IsEmpty());
  const Document lined = played(
      "lining piece=\"first second third\" "
      "open=\"first.hem first.top second.hem second.top third.hem third.top third.free\"\n");
  EXPECT_THAT(named(lined, wornInsideOut(lined.pattern)),
              UnorderedElementsAre("first_lining", "second_lining", "third_lining"));
  EXPECT_THAT(down(lined), UnorderedElementsAre("first_lining", "second_lining"));  // the third is symmetric
  const Document faced = played("facing edges=\"third.top second.top\" width=5cm\n");
  EXPECT_THAT(down(faced), UnorderedElementsAre("second_facing"));
  const std::string pairs = "quantity piece=second_facing count=2 pairs=yes\n";
  EXPECT_THAT(down(played("facing edges=second.top width=5cm\n" + pairs)), testing::IsEmpty());

  CutFacts facts;
  facts.faceDown = true;
  std::string label;
  for (const Message& line : labelOf(*faced.pieceNamed("second_facing"), facts)) label += text(line) + "\n";
  EXPECT_THAT(label, testing::HasSubstr("face down"));
  for (const bool folded : {false, true}) {
    LaySettings settings;
    settings.tries = 50, settings.folded = folded, settings.nap = true;
    const auto plan = layPlan(faced, settings, room.context);
    ASSERT_TRUE(plan) << text(plan.error().what);
    for (const LaidPiece& laid : plan->fabrics.front().pieces)
      EXPECT_EQ(laid.over, plan->document.find(laid.piece)->name == "second_facing");
  }
}

// What is eased in on purpose is so in the lining and the facing, too; in a record of before that was copied it is not.
TEST(FacedEdges, AndLiningsHaveTheEasesOfTheirSeams) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kPanels) + "ease seam=s4 by=4mm\n"));
  const auto eases = [&](const std::string& line, bool recorded) {
    room.context.recorded = recorded;
    const auto after = apply(file.document(), op(line), room.context);
    room.context.recorded = false;
    EXPECT_TRUE(after) << text(after.error().what);
    std::vector<double> all;
    for (const auto& [id, ease] : after->eases)
      if (id != file.document().pattern.seams.begin()->first) all.push_back(ease);
    return all;
  };
  EXPECT_THAT(eases("lining piece=\"first second\"", false), testing::ElementsAre(testing::DoubleEq(0.004)));
  EXPECT_THAT(eases("lining piece=\"first second\"", true), testing::IsEmpty());
  EXPECT_THAT(eases("lining piece=\"first second\" eases=no", false), testing::IsEmpty());
  EXPECT_THAT(eases("lining piece=first", false), testing::IsEmpty()) << "the seam is not sewn in the lining";
  const std::string faced = "facing edges=\"first.top second.top\" width=5cm";
  ASSERT_EQ(eases(faced, false).size(), 1u);
  EXPECT_NEAR(eases(faced, false)[0], 0.004 / 6, 0.0001) << "of 30 cm";
  EXPECT_THAT(eases(faced, true), testing::IsEmpty());
}

}  // namespace
}  // namespace karinui
