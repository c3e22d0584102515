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

// The skirt lined before it was ever draped.
std::string linedFirst() {
  const std::string skirt(kSkirt);
  return skirt.substr(0, skirt.rfind("drape")) +
         "lining piece=\"front back\" open=\"front.hem back.hem\" shorter=25mm\n";
}

// The first time, the rest of the garment is draped before its lining, which is recorded: played again, the cloth comes
// to the same bits. A second drape, and a record of before, drape all at once.
TEST(Lining, OfAGarmentNeverDrapedIsLaidInLast) {
  Workroom& room = drapingRoom();
  std::vector<std::size_t> live;
  const auto watch = [&](const Document& d, const DrapePieces& drape, Context& own) {
    live.push_back(livePieces(d, drape.live).size());
    EXPECT_EQ(d.pattern.pieces.size(), live.back());
    return drapeOnBody(d, drape, own);
  };
  room.context.drape = watch;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, linedFirst());
  ASSERT_TRUE(played) << text(played.error().what);
  const Document hung = file.document();
  const auto step = file.perform(DrapePieces{}, room.context);
  ASSERT_TRUE(step) << text(step.error().what);
  EXPECT_THAT(live, testing::ElementsAre(2, 4));
  EXPECT_THAT(text(step->operation), testing::HasSubstr("inside_last=yes"));
  const Document& document = file.document();
  expectHangsWell(document);
  const Piece &front = *document.pieceNamed("front"), &lining = *document.pieceNamed("front_lining");
  for (const double v : {0.3, 0.5, 0.7}) {
    const Edge &left = *findEdge(front, "left"), &right = *findEdge(front, "right");
    expectWithin(document, lining, front, lerp(left.curve.atFraction(v), right.curve.atFraction(1 - v), 0.5));
  }
  room.context.recorded = true;
  const auto again = apply(hung, *parseOperation(text(step->operation)), room.context);
  ASSERT_TRUE(again);
  EXPECT_EQ(drapeHash(*again), step->stand);
  room.context.drape = watch, live.clear();
  DrapePieces old;
  for (const PieceId id : livePieces(hung, {})) old.live.emplace_back(id);
  old.stop = 3;  // soon
  ASSERT_TRUE(apply(hung, old, room.context));
  room.context.recorded = false;
  ASSERT_TRUE(file.perform(DrapePieces{}, room.context));
  EXPECT_THAT(live, testing::ElementsAre(4, 4));
  EXPECT_THAT(text(file.steps().back().operation), testing::Not(testing::HasSubstr("inside_last")));
}

// Stopped while the skirt is draped or when its lining is in it, it stays there, and is played again to the same bits.
TEST(Lining, LaidInLastIsStoppedWhereItIs) {
  Workroom& room = drapingRoom();
  StopRequest* stop = nullptr;
  int stopAt = 0, steps = 0;
  bool inside = false;  // counted once the lining is in
  room.context.drape = [&](const Document& d, const DrapePieces& drape, Context& own) {
    const bool counted = !inside || d.pattern.pieces.size() == 4;
    return drapeOnBody(d, drape, own, [&, counted](const FormsNow&) {
      if (counted && ++steps == stopAt && stop) stop->ask();
    });
  };
  for (const bool later : {false, true}) {
    DocumentFile file = DocumentFile::inMemory();
    ASSERT_TRUE(room.play(file, linedFirst()));
    const Document hung = file.document();
    StopRequest request;
    inside = later, stopAt = 5, steps = 0;
    room.context.stop = stop = &request;
    const auto step = file.perform(DrapePieces{}, room.context);
    room.context.stop = stop = nullptr;
    ASSERT_TRUE(step) << text(step.error().what);
    EXPECT_GE(std::get<DrapePieces>(step->operation).stop, later ? 6 : 5);
    EXPECT_TRUE(std::get<DrapePieces>(step->operation).insideLast);
    EXPECT_FALSE(file.document().drape.last->settled);
    EXPECT_EQ(file.document().drape.dirty.size(), 4u);
    room.context.recorded = true;
    const auto again = apply(hung, *parseOperation(text(step->operation)), room.context);
    room.context.recorded = false;
    ASSERT_TRUE(again);
    EXPECT_EQ(drapeHash(*again), step->stand) << later;
  }
}

}  // namespace
}  // namespace karinui
