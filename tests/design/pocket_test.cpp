// Pockets in a seam and slanted ones: their paper, and how they hang.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "karinui/design/sewing_order.h"
#include "karinui/pattern/facing.h"
#include "karinui/pattern/markings.h"
#include "karinui/pattern/pockets.h"

namespace karinui {
namespace {

const char* const kBlockSkirt = "body size=eu38\nset spacing=20mm\nblock kind=skirt\n";
const char* const kBlockTrousers = "body size=eu38\nset spacing=20mm\nblock kind=trousers\n";

Document sewnUp(Workroom& room, const std::string& script) {
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, script);
  EXPECT_TRUE(played) << text(played.error().what);
  return file.document();
}

const Seam& seamOf(const Document& document, const std::string& name) {
  for (const auto& [id, seam] : document.pattern.seams)
    if (seam.name == name) return seam;
  ADD_FAILURE() << "no seam " << name;
  return document.pattern.seams.begin()->second;
}

bool notchedAt(const Document& document, const Piece& piece, Flat place) {
  const auto notches = notchPlaces(document.pattern);
  return std::any_of(notches.begin(), notches.end(), [&](const NotchPlace& notch) {
    return notch.piece == piece.id && distance(notch.place, place) < 1e-4;
  });
}

// Layers that lie behind one another, from the outermost, beside the middle of the second at these shares of its
// height.
void expectInOrder(const Document& document, const std::array<const Piece*, 3>& layers,
                   std::initializer_list<double> shares) {
  const FlatBox box = boxOf(layers[1]->outline.flattened(1e-4));
  for (const double down : shares) {
    const Flat at{(box.low.u + box.high.u) / 2, std::lerp(box.high.v, box.low.v, down)};
    for (const std::size_t k : {1u, 2u}) expectWithin(document, *layers[k], *layers[k - 1], at);
  }
}

double lowest(const Piece& piece) { return boxOf(piece.outline.flattened(1e-4)).low.v; }

// The opening begins and ends where it was asked for, with notches on both edges and on both bags; the bags are cut
// alike, hang below it, and are cut from their own cloth. Both sides of the skirt have one.
TEST(Pocket, InASeamHasItsPaper) {
  Workroom room;
  const Document document = sewnUp(
      room, std::string(kBlockSkirt) +
                "pocket edge=skirt_front.side_left first=5cm length=16cm depth=15cm below=10cm fabric=viscose\n");
  const Piece &front = *document.pieceNamed("skirt_front"), &back = *document.pieceNamed("skirt_back");
  for (const std::string end : {"", "_mirrored"}) {
    const Piece &upper = *document.pieceNamed("pocket_bag_front" + end),
                &under = *document.pieceNamed("pocket_bag_back" + end);
    const Seam& opening = seamOf(document, "pocket_opening" + end);
    EXPECT_NEAR(length(document.pattern, opening.a), 0.16, 1e-6);
    EXPECT_EQ(upper.outline, under.outline);
    EXPECT_EQ(upper.fabric, "viscose");
    EXPECT_EQ(under.fabric, "viscose");
    EXPECT_GT(front.layer, upper.layer);
    EXPECT_GT(upper.layer, under.layer);
    const EdgeSpan& own = opening.a.front().piece == front.id ? opening.a.front() : opening.b.front();
    const Curve& side = findEdge(front, own.edge)->curve;
    double begins = std::min(own.from, 1 - own.to) * side.length();
    EXPECT_NEAR(begins, 0.05, 1e-6);
    for (const double at : {own.from, own.to}) {
      EXPECT_TRUE(notchedAt(document, front, side.atFraction(at)));
      EXPECT_TRUE(notchedAt(document, upper, side.atFraction(at)));
      EXPECT_TRUE(notchedAt(document, under, side.atFraction(at)));
    }
    const EdgeSpan& other = opening.a.front().piece == back.id ? opening.a.front() : opening.b.front();
    for (const double at : {other.from, other.to})
      EXPECT_TRUE(notchedAt(document, back, findEdge(back, other.edge)->curve.atFraction(at)));
    const double low = std::min(side.atFraction(own.from).v, side.atFraction(own.to).v);
    EXPECT_NEAR(low - lowest(upper), 0.10, 0.012) << "along the side, which slants";
  }
  EXPECT_EQ(document.pieceNamed("pocket_bag_front_mirrored")->mirrorOf, document.pieceNamed("pocket_bag_front")->id);
  EXPECT_EQ(pocketsOf(document.pattern).size(), 2u);
}

// At rest the opening is closed, and the bags lie in order behind the front, with nothing through anything.
TEST(Pocket, InASeamHangsWithin) {
  const Document document =
      sewnUp(drapingRoom(), std::string(kBlockSkirt) + "pocket edge=skirt_front.side_left\ndrape\n");
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("skirt_front"), &upper = *document.pieceNamed("pocket_bag_front"),
              &under = *document.pieceNamed("pocket_bag_back");
  expectInOrder(document, {&front, &upper, &under}, {0.3, 0.5, 0.7});
}

// Near a waist the bags reach up to it and are caught in there; farther down they hang from the side alone.
TEST(Pocket, HangsFromTheWaist) {
  const auto with = [](const std::string& first) {
    return sewnUp(drapingRoom(), std::string(kBlockSkirt) + "pocket edge=skirt_front.side_left " + first + "\ndrape\n");
  };
  for (const bool near : {true, false}) {
    const Document document = with(near ? "first=3cm" : "first=12cm");
    expectHangsWell(document);
    const Piece &front = *document.pieceNamed("skirt_front"), &bag = *document.pieceNamed("pocket_bag_front");
    const FlatBox box = boxOf(bag.outline.flattened(1e-4));
    const Edge& side = *findEdge(front, "side_left");
    const double waist = std::max(side.curve.start.v, side.curve.end.v);
    EXPECT_EQ(box.high.v > waist - 0.02, near) << box.high.v << " of " << waist;
    EXPECT_EQ(bag.outline.edges.size(), near ? 3u : 2u);
  }
}

// Lined, the bags hang between the skirt and its lining, whichever was sewn first.
TEST(Pocket, LiesAboveTheLining) {
  const std::string pocket = "pocket edge=skirt_front.side_left\n",
                    lining = "lining piece=\"skirt_front skirt_back\" open=\"skirt_front.hem* skirt_back.hem*\"\n";
  const Document before = sewnUp(drapingRoom(), kBlockSkirt + pocket + lining),
                 after = sewnUp(drapingRoom(), kBlockSkirt + lining + pocket);
  for (const Document* document : {&before, &after}) {
    const int bag = document->pieceNamed("pocket_bag_back")->layer;
    EXPECT_GT(bag, document->pieceNamed("skirt_front_lining")->layer);
    EXPECT_EQ(document->pieceNamed("skirt_front_lining")->layer, document->pieceNamed("skirt_back_lining")->layer);
  }
  // Alike in their layers, they hang alike: one drape is enough.
  for (const auto& [id, piece] : before.pattern.pieces)
    EXPECT_EQ(piece->layer, after.pieceNamed(piece->name)->layer) << piece->name;
  expectHangsWell(sewnUp(drapingRoom(), kBlockSkirt + pocket + lining + "drape\n"));
}

// The front loses its corner, which goes on beneath it as the side piece; the waist and the outseam are as long as they
// were, and the bag reaches as far in as that.
TEST(Pocket, SlantedHasItsPaper) {
  Workroom room;
  const Document before = sewnUp(room, kBlockTrousers);
  const Document document = sewnUp(
      room, std::string(kBlockTrousers) + "pocket kind=slant edge=leg_front_left.outseam inset=4cm length=17cm\n");
  const Piece &was = *before.pieceNamed("leg_front_left"), &front = *document.pieceNamed("leg_front_left");
  const Piece &side = *document.pieceNamed("pocket_side"), &bag = *document.pieceNamed("pocket_bag");
  const Curve& slant = findEdge(front, "slant")->curve;
  EXPECT_NEAR(findEdge(was, "outseam")->curve.length() - findEdge(front, "outseam")->curve.length(), 0.17, 1e-6);
  EXPECT_NEAR(slant.length(), std::hypot(0.04, 0.17), 0.01);
  EXPECT_EQ(side.fabric, front.fabric);
  EXPECT_EQ(bag.fabric, "cotton");
  EXPECT_TRUE(findCurve(side, "slant")) << "where the front's edge lies is drawn on the side piece";
  EXPECT_EQ(findEdge(side, "inner")->curve.length(), findEdge(bag, "inner")->curve.length());
  EXPECT_NEAR(side.outline.area() - bag.outline.area(), was.outline.area() - front.outline.area(), 1e-8);
  for (const std::string name : {"pocket_side", "pocket_bag"})
    EXPECT_EQ(document.pieceNamed(name + "_mirrored")->mirrorOf, document.pieceNamed(name)->id);
  EXPECT_EQ(document.pieceNamed("leg_front_right")->mirrorOf, front.id);
  EXPECT_FALSE(wornInsideOut(document.pattern).contains(side.id)) << "it shows its right side in the corner";
  EXPECT_TRUE(wornInsideOut(document.pattern).contains(bag.id));
  EXPECT_EQ(pocketsOf(document.pattern).size(), 2u);
}

TEST(Pocket, SlantedHangsWithin) {
  const Document document =
      sewnUp(drapingRoom(), std::string(kBlockTrousers) + "pocket kind=slant edge=leg_front_left.outseam\ndrape\n");
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("leg_front_left"), &side = *document.pieceNamed("pocket_side"),
              &bag = *document.pieceNamed("pocket_bag");
  expectInOrder(document, {&front, &bag, &side}, {0.5, 0.7, 0.85});
}

// A waistband is sewn on over the front and its side piece alike, before the pocket or after it.
TEST(Pocket, TheWaistbandGoesOnOverTheSidePiece) {
  const std::string band = "band name=waistband depth=4cm sew=yes of=\"",
                    pocket = "pocket kind=slant edge=leg_front_left.outseam\n";
  Workroom room;
  const Document first = sewnUp(room, kBlockTrousers + band +
                                          "leg_back_left.waist* leg_front_left.waist* leg_front_right.waist* "
                                          "leg_back_right.waist*\"\n" +
                                          pocket);
  const Document later =
      sewnUp(room, kBlockTrousers + pocket + band +
                       "leg_back_left.waist* pocket_side.waist* leg_front_left.waist* "
                       "leg_front_right.waist* pocket_side_mirrored.waist* leg_back_right.waist*\"\n");
  for (const Document* document : {&first, &later}) {
    const PieceId waistband = document->pieceNamed("waistband")->id, side = document->pieceNamed("pocket_side")->id;
    EXPECT_TRUE(std::any_of(document->pattern.seams.begin(), document->pattern.seams.end(), [&](const auto& seam) {
      const auto on = [&](PieceId piece) { return [piece](const EdgeSpan& span) { return span.piece == piece; }; };
      return std::any_of(seam.second.a.begin(), seam.second.a.end(), on(waistband)) &&
             std::any_of(seam.second.b.begin(), seam.second.b.end(), on(side));
    }));
  }
}

// Amended, the opening is longer, and all else follows; undone, the seam is whole again.
TEST(Pocket, IsChangedLater) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kBlockSkirt) + "pocket edge=skirt_front.side_left\n"));
  const std::string sewn = hash(file.document());
  ASSERT_TRUE(file.amend(4, op("pocket edge=skirt_front.side_left length=20cm name=hip"), room.context));
  EXPECT_NEAR(length(file.document().pattern, seamOf(file.document(), "hip_opening").a), 0.20, 1e-6);
  ASSERT_TRUE(file.undo(room.context));
  EXPECT_EQ(file.document().pattern.pieces.size(), 2u);
  ASSERT_TRUE(room.play(file, "pocket edge=skirt_front.side_left\n"));
  EXPECT_EQ(hash(file.document()), sewn);
}

// One side only, where that is asked for, and in a record that left it open.
TEST(Pocket, OnOneSide) {
  Workroom room;
  for (const std::string pocket : {"pocket edge=skirt_front.side_left", "pocket kind=slant edge=skirt_front.side_left"})
    EXPECT_EQ(sewnUp(room, kBlockSkirt + pocket + " copies=no\n").pattern.pieces.size(), 4u) << pocket;
  const Document legs =
      sewnUp(room, std::string(kBlockTrousers) + "pocket kind=slant copies=no edge=leg_front_left.outseam\n");
  EXPECT_TRUE(legs.pieceNamed("pocket_side"));
  EXPECT_FALSE(findEdge(*legs.pieceNamed("leg_front_right"), "slant"));
}

// The bags are sewn to the opening while it lies open, and the opening is not sewn.
TEST(Pocket, IsSewnInOrder) {
  Workroom room;
  for (const std::string& script :
       {std::string(kBlockSkirt) + "pocket copies=no edge=skirt_front.side_left\n",
        std::string(kBlockTrousers) + "pocket kind=slant copies=no edge=leg_front_left.outseam\n"}) {
    const Document document = sewnUp(room, script);
    std::string order;
    for (const SewingStep& step : sewingOrder(document)) order += text(step.words) + "\n";
    const auto bags = order.find("Sew the pocket bag"), opening = order.find("Baste, and do not sew, seam");
    EXPECT_NE(opening, std::string::npos) << order;
    EXPECT_LT(bags, opening) << order;
    const auto joined = order.find("Seam ");  // what is sewn one after the other
    EXPECT_LT(opening, joined) << order;
    EXPECT_EQ(order.find(": opening of pocket\n"), std::string::npos) << "it is not sewn as a seam: " << order;
  }
}

}  // namespace
}  // namespace karinui
