#pragma once
// A workroom whose drapes are the solver's, and a skirt that hangs in it.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/check/check.h"
#include "karinui/design/drape.h"

namespace karinui {

inline Workroom& drapingRoom() {
  static Workroom room;  // the figure is built once
  room.context.drape = [](const Document& d, const DrapePieces& pieces, Context& own) {
    return drapeOnBody(d, pieces, own);
  };
  return room;
}

// A wide skirt that hangs from the waist, at rest: `front` and `back`, each with hem, left, waist and right.
inline const char* const kSkirt = R"(body size=eu38
set spacing=30mm
ring name=front inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
ring name=back inner="waist_girth/2 + 1cm" depth=45cm angle=70deg fabric=linen edges="hem left waist right"
place piece=front at="torso:waist-0.3@0" ease=12mm
place piece=back at="torso:waist-0.3@0.5" ease=12mm
sew a=front.left b=back.right
sew a=front.right b=back.left
drape
)";

// At rest, sewn up, and nothing through anything.
inline void expectHangsWell(const Document& document) {
  EXPECT_TRUE(document.drape.last->settled) << text(document.drape.last->why);
  const auto standing = standingCloth(document, livePieces(document, {}));
  ASSERT_TRUE(standing);
  const BodyPtr body = *bodyOf(document, drapingRoom().context);
  const ClothCheck found = check(standing->cloth, standing->state, body.get());
  EXPECT_EQ(found.clothClothCrossings, 0u);
  EXPECT_EQ(found.clothBodyCrossings, 0u);
  EXPECT_NEAR(found.seamGap, 0, 1e-6);
}

// A place on the paper of a piece that lies within another is not farther out than the same place on that.
inline void expectWithin(const Document& document, const Piece& within, const Piece& outside, Flat place) {
  const BodyPtr body = *bodyOf(document, drapingRoom().context);
  const auto out = [&](const Piece& piece) { return body->bvh().signedDistance(Stand(piece)(place)); };
  EXPECT_LT(out(within), out(outside) + 0.004) << place.u << ", " << place.v;
}

}  // namespace karinui
