// Pockets whose seams are altered afterwards: bags, side piece and opening go with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "karinui/pattern/pockets.h"

namespace karinui {
namespace {

const char* const kSkirtWithPockets =
    "body size=eu38\nset spacing=20mm\nblock kind=skirt\npocket edge=skirt_front.side_left\n";
const char* const kTrousersWithPockets =
    "body size=eu38\nset spacing=20mm\nblock kind=trousers\npocket kind=slant edge=leg_front_left.outseam\n";

Document alteredGarment(Workroom& room, const std::string& script) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, script);
  EXPECT_TRUE(played) << text(played.error().what);
  return file.document();
}

Curve stretchOf(const Document& document, const EdgeSpan& span) {
  const Curve& whole = *findCurve(*document.find(span.piece), span.edge);
  return whole.part(whole.parameterAt(span.from * whole.length()), whole.parameterAt(span.to * whole.length()));
}

// What hangs behind an edge, paper on paper, lies on it from end to end.
void expectOnOneLine(const Document& document, const Seam& seam, const char* what) {
  ASSERT_EQ(seam.a.size(), seam.b.size()) << what;
  for (std::size_t k = 0; k < seam.a.size(); ++k) {
    const Curve outer = stretchOf(document, seam.a[k]), own = stretchOf(document, seam.b[k]);
    for (const double at : {0.0, 0.5, 1.0})
      EXPECT_LT(distance(outer.atFraction(at), own.atFraction(at)), 1e-5) << what << " " << seam.b[k].edge << " " << at;
  }
}

void expectPocketsOnPaper(const Document& document, std::size_t many) {
  const auto pockets = pocketsOf(document.pattern);
  EXPECT_EQ(pockets.size(), many);
  for (const SewnPocket& pocket : pockets) {
    for (const SeamId id : pocket.caught)
      if (const Seam& caught = *document.find(id); !caught.reversed) expectOnOneLine(document, caught, "caught");
    expectOnOneLine(document, *document.find(pocket.round), "round");
    const Seam& opening = *document.find(pocket.opening);
    if (!opening.reversed) expectOnOneLine(document, opening, "opening");
  }
  for (const auto& [id, seam] : document.pattern.seams) {
    if (seam.tie == Seam::Tie::Pleat && !seam.reversed) expectOnOneLine(document, seam, "behind");
  }
}

// How wide the paper is across a side, at a height.
double insideAt(const Piece& piece, double height) {
  double left = HUGE_VAL, right = -HUGE_VAL;
  const Ring ring = piece.outline.flattened(1e-4);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Flat a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.v > height) == (b.v > height)) continue;
    const double u = std::lerp(a.u, b.u, (height - a.v) / (b.v - a.v));
    left = std::min(left, u), right = std::max(right, u);
  }
  return right - left;
}

TEST(PocketFollows, ASideThatIsTakenInOrLetOut) {
  Workroom room;
  for (const double by : {0.01, -0.012}) {
    const std::string alter = " by=" + std::to_string(by * 1000) + "mm\n";
    const Document skirt = alteredGarment(room, kSkirtWithPockets + ("takein edges=skirt_front.side_left" + alter));
    expectPocketsOnPaper(skirt, 2);
    const Document before = alteredGarment(room, kSkirtWithPockets);
    const Piece &was = *before.pieceNamed("pocket_bag_back"), &is = *skirt.pieceNamed("pocket_bag_back");
    EXPECT_EQ(is.outline, skirt.pieceNamed("pocket_bag_front")->outline);
    EXPECT_NEAR(findEdge(is, "inner")->curve.length(), findEdge(was, "inner")->curve.length(), 0.004)
        << "the bag goes along, and is as large as it was";
    EXPECT_GT(distance(findEdge(is, "side")->curve.at(0.5), findEdge(was, "side")->curve.at(0.5)), 0.009);
  }
}

// The corner that a slanted pocket cut away is a part of the side.
TEST(PocketFollows, TheSidePieceOfASlantedOneIsTakenInToo) {
  Workroom room;
  const Document before = alteredGarment(room, kTrousersWithPockets);
  for (const char* edge : {"leg_front_left.outseam", "leg_back_left.outseam", "pocket_side.outseam_2"}) {
    const Document after =
        alteredGarment(room, std::string(kTrousersWithPockets) + "takein edges=" + edge + " by=1cm\n");
    expectPocketsOnPaper(after, 2);
    for (const std::string end : {"", "_mirrored"}) {
      const Piece &was = *before.pieceNamed("pocket_side" + end), &is = *after.pieceNamed("pocket_side" + end);
      EXPECT_NEAR(findEdge(was, "waist")->curve.length() - findEdge(is, "waist")->curve.length(), 0.01, 1e-3) << edge;
      EXPECT_LT(distance(findEdge(was, "top_under")->curve.at(0.5), findEdge(is, "top_under")->curve.at(0.5)), 1e-9)
          << "the waist stays: " << edge;
    }
    for (const auto& [id, seam] : after.pattern.seams)
      EXPECT_NEAR(lengthMismatch(after.pattern, seam), lengthMismatch(before.pattern, *before.find(id)), 0.004)
          << edge << ", seam " << seam.name;
  }
}

// The bag was taken in all round and came through the side piece.
TEST(PocketFollows, WhatIsTakenInComesToRest) {
  const Document document = alteredGarment(drapingRoom(),
                                           "body size=jis9ar\nset spacing=14mm\nblock kind=trousers\ndrape\n"
                                           "pocket kind=slant edge=leg_front_left.outseam\ndrape\n"
                                           "takein edges=leg_front_left.outseam by=1cm\ndrape\n");
  expectHangsWell(document);
}

// Points dragged on the paper, a side redrawn, the waist let down.
TEST(PocketFollows, OtherEdits) {
  Workroom room;
  for (const char* edit : {"takein edges=\"skirt_front.side_left skirt_back.side_left\" at=0.8 by=1cm",
                           "length edge=skirt_front.side_left to=60cm",
                           "reshape piece=skirt_front at=\"22cm,-10cm\" by=\"2cm,0,0\" within=15cm",
                           "spread from=skirt_front.hem_left to=skirt_front.waist_left_2 by=4cm",
                           "takein edges=\"skirt_front.waist_left skirt_front.waist_left_2\" by=1cm"}) {
    DocumentFile file = DocumentFile::inMemory();
    ASSERT_TRUE(room.play(file, kSkirtWithPockets));
    const auto played = room.play(file, std::string(edit) + "\n");
    EXPECT_TRUE(played) << edit << ": " << text(played.error().what);
    SCOPED_TRACE(edit);
    expectPocketsOnPaper(file.document(), 2);
  }
}

// The bags are as wide as they should be beneath a dart that ends the edge above.
TEST(PocketFollows, ABagIsWideBesideADart) {
  Workroom room;
  for (const bool slant : {false, true}) {
    const Document document = alteredGarment(room, slant ? kTrousersWithPockets : kSkirtWithPockets);
    const Piece& bag = *document.pieceNamed(slant ? "pocket_side" : "pocket_bag_front");
    const FlatBox box = boxOf(bag.outline.flattened(1e-4));
    for (const double down : {0.06, 0.10, 0.15})
      EXPECT_GT(insideAt(bag, box.high.v - down), 0.135) << slant << " " << down;
  }
}

}  // namespace
}  // namespace karinui
