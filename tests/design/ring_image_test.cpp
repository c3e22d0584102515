// What is sewn to a band that goes all round and was begun at a side has a mirror image on the same band.
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

const char* const kBraces =
    "body size=eu38\nblock kind=skirt\nband name=waistband depth=4cm sew=yes of=\"skirt_front.waist* "
    "skirt_back.waist*\"\n";

TEST(RingImage, ASecondBraceIsSewnToTheSameBand) {
  for (const bool recorded : {false, true}) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done begun = room.play(file, kBraces);
    ASSERT_TRUE(begun) << text(begun.error().what);
    // Where the middle of the front's left half and of the back's left half come.
    const Piece& band = *file.document().pieceNamed("waistband");
    const Curve& top = findEdge(band, "top")->curve;
    const auto shareAt = [&](double x, double side) {
      double found = 0, least = HUGE_VAL;
      for (int k = 0; k <= 400; ++k) {
        const Vec3 at = Stand(band)(top.atFraction(k / 400.0));
        if (at.z * side > 0 && std::fabs(at.x - x) < least) least = std::fabs(at.x - x), found = k / 400.0;
      }
      return found;
    };
    const auto part = [](double at) {
      return "waistband.top@" + std::to_string(at - 0.015) + ":" + std::to_string(at + 0.015);
    };
    const Done sewn =
        room.play(file, "strap name=brace from=" + part(shareAt(0.07, 1)) + " to=" + part(shareAt(0.07, -1)) + "\n");
    ASSERT_TRUE(sewn) << text(sewn.error().what);
    room.context.recorded = recorded;
    const auto after = apply(file.document(), op("mirror piece=brace name=other sewn=yes"), room.context);
    ASSERT_TRUE(after) << text(after.error().what);
    const PieceId brace = after->pieceNamed("brace")->id, other = after->pieceNamed("other")->id;
    const auto ends = [&](PieceId piece) {
      std::vector<Vec3> places;
      for (const auto& [id, seam] : after->pattern.seams) {
        if (seam.a.front().piece != piece) continue;
        const EdgeSpan& to = seam.b.front();
        places.push_back(Stand(*after->find(to.piece))(top.atFraction((to.from + to.to) / 2)));
      }
      return places;
    };
    const auto own = ends(brace), image = ends(other);
    ASSERT_EQ(own.size(), 2u);
    ASSERT_EQ(image.size(), recorded ? 0u : 2u);
    for (std::size_t k = 0; k < image.size(); ++k)
      EXPECT_LT(distance(image[k], {-own[k].x, own[k].y, own[k].z}), 0.005);
  }
}

}  // namespace
}  // namespace karinui
