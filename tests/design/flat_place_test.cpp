// Pieces that are stood flat before or behind the body, as a front that is cut in one with its sleeves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

Document stoodFlat(const std::string& script) {
  static Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done done =
      room.play(file,
                "body size=eu38\npolygon name=front symmetric=yes edges=\"hem side underarm cuff shoulder "
                "neck centre\" points=\"0,-18cm; 26cm,-18cm; 26cm,8cm; 41cm,7cm; 49cm,21cm; 8cm,42cm; "
                "0,34cm\"\n" +
                    script);
  EXPECT_TRUE(done) << text(done.error().what);
  return file.document();
}

// It is bent nowhere, keeps its lengths, and stands clear of bust, arms and hands by its ease.
TEST(PlacedFlat, StandsClearBeforeAndBehindTheBody) {
  Workroom room;
  for (const bool before : {true, false}) {
    const Document document = stoodFlat(std::string("place piece=front at=\"torso:waist@") + (before ? "0" : "0.5") +
                                        "\" point=0,0 ease=2cm flat=yes\n");
    const Piece& front = *document.pieceNamed("front");
    const auto body = bodyOf(document, room.context);
    ASSERT_TRUE(body);
    const double waist = (*body)->measured().value.at("waist_height");
    const Form& form = *front.form;
    double nearest = HUGE_VAL;
    for (std::size_t k = 0; k < form.flat.size(); ++k) {
      const Vec3 stands = front.pose(form.space[k]);
      EXPECT_NEAR(stands.z, front.pose(form.space[0]).z, 1e-9);
      EXPECT_GT(stands.z * (before ? 1 : -1), 0);
      EXPECT_NEAR(stands.x, form.flat[k].u * (before ? 1 : -1), 0.01);
      EXPECT_NEAR(stands.y, waist + form.flat[k].v, 0.01);
      nearest = std::min(nearest, (*body)->bvh().signedDistance(stands));
    }
    EXPECT_GT(nearest, 0.015);
    EXPECT_LT(nearest, 0.06);
  }
}

TEST(PlacedFlat, GoesRoundNothing) {
  Workroom room;
  const Document document = stoodFlat("");
  for (const char* other : {"taper=yes", "arc=0.5", "wrap=side_left"}) {
    const auto placed =
        apply(document, op("place piece=front at=torso:waist@0 flat=yes " + std::string(other)), room.context);
    ASSERT_FALSE(placed) << other;
    EXPECT_THAT(text(placed.error().what), testing::HasSubstr("flat")) << other;
  }
}

}  // namespace
}  // namespace karinui
