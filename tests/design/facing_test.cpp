// A facing lies within what it faces.
#include <gtest/gtest.h>

#include "design/draping_room.h"

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

}  // namespace
}  // namespace karinui
