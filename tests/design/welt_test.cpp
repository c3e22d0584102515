// Welt pockets: their paper, and how they hang.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "karinui/design/sewing_order.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/facing.h"

namespace karinui {
namespace {

const char* const kFigureInTrousers = "body size=eu38\nset spacing=20mm\nblock kind=trousers\n";
const char* const kBackPocket = "welt piece=leg_back_left at=-10cm,-16cm turn=-3deg\n";

Document withWelts(Workroom& room, const std::string& script) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, script);
  EXPECT_TRUE(played) << text(played.error().what);
  return file.document();
}

// The box is stitched where it was asked for, with the cuts in it; welt and bags are cut to it.
TEST(Welt, HasItsPaper) {
  Workroom room;
  const Document document = withWelts(room, std::string(kFigureInTrousers) + kBackPocket);
  const AllowancePlan allowances(document.pattern, document.allowances);
  for (const std::string end : {"", "_mirrored"}) {
    const Piece& back = *document.pieceNamed(end.empty() ? "leg_back_left" : "leg_back_right");
    const Piece &welt = *document.pieceNamed("pocket_welt" + end),
                &front = *document.pieceNamed("pocket_bag_front" + end),
                &under = *document.pieceNamed("pocket_bag_back" + end);
    EXPECT_NEAR(findCurve(back, "pocket_low")->length(), 0.135, 1e-9);
    EXPECT_NEAR(distance(findCurve(back, "pocket_low")->at(0.5), findCurve(back, "pocket_top")->at(0.5)), 0.01, 1e-9);
    const Flat middle = lerp(findCurve(back, "pocket_low")->at(0.5), findCurve(back, "pocket_top")->at(0.5), 0.5);
    EXPECT_LT(distance(middle, {end.empty() ? -0.10 : 0.10, -0.16}), 1e-9);
    EXPECT_EQ(back.lines.size(), 7u) << "box, slit and the cuts into its corners";
    EXPECT_NEAR(welt.outline.area(), 0.135 * 0.01, 1e-9);
    EXPECT_NEAR(allowances.width(welt.id, "top"), 0.025, 1e-9) << "each jet is folded back and turned in";
    EXPECT_NEAR(allowances.width(welt.id, "low"), 0.025, 1e-9);
    EXPECT_EQ(welt.fabric, back.fabric);
    EXPECT_EQ(under.fabric, back.fabric) << "it shows where the pocket gapes";
    EXPECT_EQ(front.fabric, "cotton");
    EXPECT_EQ(findEdge(front, "inner")->curve, findEdge(under, "inner")->curve);
    EXPECT_GT(welt.layer, back.layer);
    EXPECT_GT(back.layer, front.layer);
    EXPECT_GT(front.layer, under.layer);
    EXPECT_TRUE(wornInsideOut(document.pattern).contains(front.id));
    EXPECT_FALSE(wornInsideOut(document.pattern).contains(welt.id));
  }
  for (const std::string part : {"pocket_welt", "pocket_bag_front", "pocket_bag_back"})
    EXPECT_EQ(document.pieceNamed(part + "_mirrored")->mirrorOf, document.pieceNamed(part)->id);
}

// At rest the welt lies on the box, the bags hang behind it in order, and nothing goes through anything.
TEST(Welt, JetsAreClosedAtRest) {
  const Document document = withWelts(drapingRoom(), std::string(kFigureInTrousers) + kBackPocket + "drape\n");
  expectHangsWell(document);
  const Piece &back = *document.pieceNamed("leg_back_left"), &front = *document.pieceNamed("pocket_bag_front"),
              &under = *document.pieceNamed("pocket_bag_back");
  for (const double down : {0.04, 0.08, 0.12}) {
    const Flat at{-0.10, -0.16 - down};
    expectWithin(document, front, back, at);
    expectWithin(document, under, front, at);
  }
}

// A breast pocket: one welt, open above.
TEST(Welt, OneWeltOfABreastPocket) {
  const Document document =
      withWelts(drapingRoom(),
                "body size=eu38\nset spacing=20mm\nblock kind=shirt\n"
                "welt piece=front_left kind=single at=9cm,15cm turn=8deg below=12cm copies=no\ndrape\n");
  expectHangsWell(document);
  const Piece& welt = *document.pieceNamed("pocket_welt");
  EXPECT_NEAR(welt.outline.area(), 0.105 * 0.022, 1e-9);
  const AllowancePlan allowances(document.pattern, document.allowances);
  EXPECT_NEAR(allowances.width(welt.id, "top"), 0.032, 1e-9) << "its facing is cut on";
  EXPECT_NEAR(allowances.width(welt.id, "low"), 0.01, 1e-9);
  for (const auto& [id, seam] : document.pattern.seams)
    for (const EdgeSpan& span : seam.a) EXPECT_FALSE(span.piece == welt.id && span.edge == "top");
}

// Lined, the bags hang between the skirt and its lining, whichever was sewn first.
TEST(Welt, LiesAboveTheLining) {
  const std::string pocket = "welt piece=skirt_front at=10cm,-20cm below=12cm\n",
                    lining = "lining piece=\"skirt_front skirt_back\" open=\"skirt_front.hem* skirt_back.hem*\"\n";
  const auto sewn = [&](const std::string& more) {
    return withWelts(drapingRoom(), "body size=eu38\nset spacing=20mm\nblock kind=skirt\n" + more);
  };
  const Document before = sewn(pocket + lining), after = sewn(lining + pocket);
  for (const Document* document : {&before, &after})
    EXPECT_GT(document->pieceNamed("pocket_bag_back")->layer, document->pieceNamed("skirt_front_lining")->layer);
  // Alike in their layers, they hang alike: one drape is enough.
  for (const auto& [id, piece] : before.pattern.pieces)
    EXPECT_EQ(piece->layer, after.pieceNamed(piece->name)->layer) << piece->name;
  expectHangsWell(sewn(lining + pocket + "drape\n"));
}

// The slit is cut when welt and bags are sewn on.
TEST(Welt, IsSewnInOrder) {
  Workroom room;
  const Document document = withWelts(room, std::string(kFigureInTrousers) + kBackPocket);
  std::string order;
  for (const SewingStep& step : sewingOrder(document)) order += text(step.words) + "\n";
  const auto welt = order.find("Sew welt of pocket onto left back trouser leg"),
             bag = order.find("Sew back bag of pocket onto left back trouser leg"),
             slit = order.find("Slit left back trouser leg"), round = order.find("inner edge of");
  for (const auto at : {welt, bag, slit, round}) EXPECT_NE(at, std::string::npos) << order;
  EXPECT_LT(welt, slit) << order;
  EXPECT_LT(bag, slit) << order;
  EXPECT_LT(slit, round) << order;
}

TEST(Welt, IsChangedLater) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kFigureInTrousers) + kBackPocket));
  const std::string sewn = hash(file.document());
  ASSERT_TRUE(file.amend(4, op("welt piece=leg_back_left at=-10cm,-16cm length=12cm copies=no"), room.context));
  EXPECT_NEAR(findEdge(*file.document().pieceNamed("pocket_welt"), "low")->curve.length(), 0.12, 1e-9);
  EXPECT_EQ(file.document().pattern.pieces.size(), 7u);
  ASSERT_TRUE(file.undo(room.context));
  EXPECT_EQ(file.document().pattern.pieces.size(), 4u);
  EXPECT_TRUE(file.document().pieceNamed("leg_back_left")->lines.empty());
  ASSERT_TRUE(room.play(file, kBackPocket));
  EXPECT_EQ(hash(file.document()), sewn);
}

}  // namespace
}  // namespace karinui
