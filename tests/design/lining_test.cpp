// A lining hangs within what it lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"

namespace karinui {
namespace {

// Lined but for its hem, where it ends an inch higher, and at rest again.
TEST(Lining, HangsWithinTheSkirt) {
  Workroom& room = drapingRoom();
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> advice;
  room.context.advise = [&](const Advice& said) { advice.push_back(text(said.what)); };
  const auto played = room.play(
      file, std::string(kSkirt) + "lining piece=\"front back\" open=\"front.hem back.hem\" shorter=25mm\ndrape\n");
  ASSERT_TRUE(played) << text(played.error().what);
  EXPECT_THAT(advice, testing::Not(testing::Contains(testing::HasSubstr("before it is lined"))));
  const Document& document = file.document();
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("front"), &lining = *document.pieceNamed("front_lining");
  for (const Edge& edge : lining.outline.edges) {
    const double shorter = edge.name == "left" || edge.name == "right" ? 0.025 : 0;
    if (edge.name != "hem") {
      EXPECT_NEAR(edge.curve.length(), findEdge(front, edge.name)->curve.length() - shorter, 2e-5);
    }
  }
  const auto sewnLength = [&](const std::vector<EdgeSpan>& side) {
    double sum = 0;
    for (const EdgeSpan& s : side) sum += findEdge(*document.find(s.piece), s.edge)->curve.length() * (s.to - s.from);
    return sum;
  };
  for (const auto& [id, seam] : document.pattern.seams) EXPECT_NEAR(sewnLength(seam.a), sewnLength(seam.b), 1e-4);
  const Stand skirtStand(front), liningStand(lining);
  for (const double at : {0.1, 0.3, 0.5, 0.7, 0.9})
    EXPECT_GT(liningStand(findEdge(lining, "hem")->curve.atFraction(at)).y,
              skirtStand(findEdge(front, "hem")->curve.atFraction(at)).y + 0.015);
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
  const auto refused = [&](const char* words) {
    DocumentFile other = DocumentFile::inMemory();
    const auto done =
        room.play(other, std::string("rectangle name=flap width=20cm height=20cm\nlining piece=flap ") + words);
    return done ? std::string() : text(done.error().what);
  };
  EXPECT_THAT(refused("shorter=2cm"), testing::HasSubstr("at which edges"));
  EXPECT_THAT(refused("open=flap.bottom shorter=60cm"), testing::HasSubstr("0 to 50 cm"));
  EXPECT_THAT(refused("open=flap.bottom shorter=25cm"), testing::HasSubstr("shorten it by less"));
}

}  // namespace
}  // namespace karinui
