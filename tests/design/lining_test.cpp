// A lining hangs within what it lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"

namespace karinui {
namespace {

// Lined but for its hem, and at rest again.
TEST(Lining, HangsWithinTheSkirt) {
  Workroom& room = drapingRoom();
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> advice;
  room.context.advise = [&](const Advice& said) { advice.push_back(text(said.what)); };
  const auto played =
      room.play(file, std::string(kSkirt) + "lining piece=\"front back\" open=\"front.hem back.hem\"\ndrape\n");
  ASSERT_TRUE(played) << text(played.error().what);
  EXPECT_THAT(advice, testing::Not(testing::Contains(testing::HasSubstr("before it is lined"))));
  const Document& document = file.document();
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("front"), &lining = *document.pieceNamed("front_lining");
  for (const double v : {0.3, 0.5, 0.7, 0.9}) {
    const Edge& left = *findEdge(front, "left");
    const Edge& right = *findEdge(front, "right");
    expectWithin(document, lining, front, lerp(left.curve.atFraction(v), right.curve.atFraction(1 - v), 0.5));
  }
  // Lined before it is draped, it is told.
  const auto early = room.play(file, "rectangle name=flap width=20cm height=20cm\nlining piece=flap\n");
  ASSERT_TRUE(early) << text(early.error().what);
  EXPECT_THAT(advice, testing::Contains(testing::HasSubstr("before it is lined")));
  room.context.advise = {};
}

}  // namespace
}  // namespace karinui
