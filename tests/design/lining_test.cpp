// A lining hangs within what it lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/check/check.h"
#include "karinui/design/drape.h"

namespace karinui {
namespace {

Workroom& room() {
  static Workroom room;  // the figure is built once
  room.context.drape = [](const Document& d, const DrapePieces& pieces, Context& own) {
    return drapeOnBody(d, pieces, own);
  };
  return room;
}

// A wide skirt that hangs from the waist, at rest, lined but for its hem, and at rest again.
TEST(Lining, HangsWithinTheSkirt) {
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> advice;
  room().context.advise = [&](const Advice& said) { advice.push_back(text(said.what)); };
  const auto played = room().play(file, R"(body size=eu38
set spacing=30mm
ring name=front inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
ring name=back inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
place piece=front at="torso:waist-0.3@0" ease=12mm
place piece=back at="torso:waist-0.3@0.5" ease=12mm
sew a=front.left b=back.right
sew a=front.right b=back.left
drape
lining piece="front back" open="front.hem back.hem"
drape
)");
  ASSERT_TRUE(played) << text(played.error().what);
  EXPECT_THAT(advice, testing::Not(testing::Contains(testing::HasSubstr("before it is lined"))));
  const Document& document = file.document();
  EXPECT_TRUE(document.drape.last->settled) << text(document.drape.last->why);
  const auto standing = standingCloth(document, livePieces(document, {}));
  ASSERT_TRUE(standing);
  const BodyPtr body = *bodyOf(document, room().context);
  const ClothCheck found = check(standing->cloth, standing->state, body.get());
  EXPECT_EQ(found.clothClothCrossings, 0u);
  EXPECT_EQ(found.clothBodyCrossings, 0u);
  EXPECT_NEAR(found.seamGap, 0, 1e-6);
  // Of two points with the same place on paper the lining's is not farther out.
  const Piece &front = *document.pieceNamed("front"), &lining = *document.pieceNamed("front_lining");
  const Stand outer(front), inner(lining);
  for (const double v : {0.3, 0.5, 0.7, 0.9}) {
    const Edge& left = *findEdge(front, "left");
    const Edge& right = *findEdge(front, "right");
    const Flat place = lerp(left.curve.atFraction(v), right.curve.atFraction(1 - v), 0.5);
    EXPECT_LT(body->bvh().signedDistance(inner(place)), body->bvh().signedDistance(outer(place)) + 0.004) << v;
  }
  // Lined before it is draped, it is told.
  const auto early = room().play(file, "rectangle name=flap width=20cm height=20cm\nlining piece=flap\n");
  ASSERT_TRUE(early) << text(early.error().what);
  EXPECT_THAT(advice, testing::Contains(testing::HasSubstr("before it is lined")));
  room().context.advise = {};
}

}  // namespace
}  // namespace karinui
