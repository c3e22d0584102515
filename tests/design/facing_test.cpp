// A facing lies within what it faces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/check/check.h"
#include "karinui/design/drape.h"

namespace karinui {
namespace {

// A wide skirt that hangs from the waist, at rest, faced there, and at rest again.
TEST(FacedEdges, LieWithinTheSkirt) {
  Workroom room;
  room.context.drape = [](const Document& d, const DrapePieces& pieces, Context& own) {
    return drapeOnBody(d, pieces, own);
  };
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, R"(body size=eu38
set spacing=30mm
ring name=front inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
ring name=back inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
place piece=front at="torso:waist-0.3@0" ease=12mm
place piece=back at="torso:waist-0.3@0.5" ease=12mm
sew a=front.left b=back.right
sew a=front.right b=back.left
drape
facing edges="front.waist back.waist" width=9cm
drape
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const Document& document = file.document();
  EXPECT_TRUE(document.drape.last->settled) << text(document.drape.last->why);
  const auto standing = standingCloth(document, livePieces(document, {}));
  ASSERT_TRUE(standing);
  const BodyPtr body = *bodyOf(document, room.context);
  const ClothCheck found = check(standing->cloth, standing->state, body.get());
  EXPECT_EQ(found.clothClothCrossings, 0u);
  EXPECT_EQ(found.clothBodyCrossings, 0u);
  EXPECT_NEAR(found.seamGap, 0, 1e-6);
  // Of two points with the same place on paper the facing's is not farther out.
  const Piece &front = *document.pieceNamed("front"), &facing = *document.pieceNamed("front_facing");
  const Stand outer(front), inner(facing);
  for (const double f : {0.2, 0.5, 0.8}) {
    const Flat place = findEdge(facing, "inner")->curve.atFraction(f);
    EXPECT_LT(body->bvh().signedDistance(inner(place)), body->bvh().signedDistance(outer(place)) + 0.004) << f;
  }
}

}  // namespace
}  // namespace karinui
