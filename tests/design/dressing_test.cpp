// Garments are put on one after another the first time they are draped, if they stand through each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/draping_room.h"
#include "design/operations/stood_off.h"

namespace karinui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// The skirt, never draped, and another one, drawn before it, to be worn over it.
std::string twoSkirts(const std::string& easeOfTheOuter) {
  const std::string skirt(kSkirt);
  const std::size_t rings = skirt.find("ring"), drape = skirt.rfind("drape");
  std::string inner = skirt.substr(rings, drape - rings), outer = inner;
  const auto replace = [&](const std::string& what, const std::string& by) {
    for (std::size_t at = outer.find(what); at != std::string::npos; at = outer.find(what, at + by.size()))
      outer.replace(at, what.size(), by);
  };
  replace("name=", "layer=1 name=over_");
  replace("piece=", "piece=over_");
  replace("a=", "a=over_");
  replace("b=", "b=over_");
  replace("ease=12mm", "ease=" + easeOfTheOuter);
  return skirt.substr(0, rings) + outer + inner;
}

std::vector<std::string> namesOf(const Document& document) {
  std::vector<std::string> names;
  for (const auto& [id, piece] : document.pattern.pieces) names.push_back(piece->name);
  std::sort(names.begin(), names.end());
  return names;
}

DrapePieces oneAfterAnother() {
  DrapePieces drape;
  drape.dressed = true;
  return drape;
}

TEST(Dressing, AGarmentThatStandsWithinAnotherIsPutOnOverIt) {
  Workroom& room = drapingRoom();
  std::vector<std::vector<std::string>> draped;
  room.context.drape = [&](const Document& d, const DrapePieces& drape, Context& own) {
    draped.push_back(namesOf(d));
    if (draped.size() == 2)
      for (const double v : {0.2, 0.5, 0.8}) {  // it begins outside of what hangs
        const Piece &front = *d.pieceNamed("front"), &over = *d.pieceNamed("over_front");
        const Flat place =
            lerp(findEdge(front, "hem")->curve.atFraction(0.5), findEdge(front, "waist")->curve.atFraction(0.5), v);
        const BodyPtr body = *bodyOf(d, own);
        EXPECT_GT(body->bvh().signedDistance(Stand(over)(place)), body->bvh().signedDistance(Stand(front)(place)));
      }
    return drapeOnBody(d, drape, own);
  };
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, twoSkirts("6mm"));
  ASSERT_TRUE(played) << text(played.error().what);
  const Document hung = file.document();
  const auto step = file.perform(oneAfterAnother(), room.context);
  ASSERT_TRUE(step) << text(step.error().what);
  EXPECT_THAT(draped,
              ElementsAre(ElementsAre("back", "front"), ElementsAre("back", "front", "over_back", "over_front")));
  expectHangsWell(file.document());
  const Document& document = file.document();
  const Piece &front = *document.pieceNamed("front"), &over = *document.pieceNamed("over_front");
  for (const double v : {0.2, 0.5, 0.8})
    expectWithin(
        document, front, over,
        lerp(findEdge(front, "hem")->curve.atFraction(0.5), findEdge(front, "waist")->curve.atFraction(0.5), v));
  room.context.recorded = true;  // played again it comes to the same bits
  const auto again = apply(hung, *parseOperation(text(step->operation)), room.context);
  room.context.recorded = false;
  ASSERT_TRUE(again);
  EXPECT_EQ(drapeHash(*again), step->stand);
}

// At once is soonest done. What is given up there, as garments stand through each other, is put on one after another,
// which is recorded. So is what was stopped on the way. What came to rest, and a record of before, is not given up.
TEST(Dressing, IsChosenWhereGarmentsStandThroughEachOther) {
  Workroom room;
  std::vector<std::string> tried;
  bool cross = true;
  room.context.drape = [&](const Document&, const DrapePieces& drape, Context& own) {
    auto outcome = fallABit({}, {});
    if (drape.stop > 0) outcome->report.settled = false, outcome->report.stoppedAfter = 3;
    tried.push_back(std::to_string(drape.live.size()) + (own.giveUpCrossed ? " may be given up" : "") +
                    (own.fromCoarsest ? " from the coarsest" : ""));
    if (cross && own.giveUpCrossed) outcome->report.crossed = true, outcome->report.settled = false;
    return outcome;
  };
  const auto draped = [&](bool again = false) {
    DocumentFile file = DocumentFile::inMemory();
    EXPECT_TRUE(room.play(file, twoSkirts("6mm")));
    if (again) {
      EXPECT_TRUE(file.perform(DrapePieces{}, room.context));
    }
    tried.clear();
    const auto step = file.perform(DrapePieces{}, room.context);
    EXPECT_TRUE(step);
    return step ? text(step->operation) : std::string();
  };
  EXPECT_THAT(draped(), HasSubstr("dressed=yes"));
  EXPECT_THAT(tried, ElementsAre("4 may be given up", "2", "4 from the coarsest"));
  EXPECT_THAT(draped(true), Not(HasSubstr("dressed")));
  EXPECT_THAT(tried, ElementsAre("4"));
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, twoSkirts("6mm") + "drape stop=3\n"));
  tried.clear();
  ASSERT_TRUE(file.perform(DrapePieces{}, room.context));
  EXPECT_THAT(tried, ElementsAre("4 may be given up", "2", "4 from the coarsest"));
  tried.clear();
  file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, twoSkirts("6mm")));
  room.context.recorded = true;
  DrapePieces old;
  for (const PieceId id : livePieces(file.document(), {})) old.live.emplace_back(id);
  ASSERT_TRUE(apply(file.document(), old, room.context));
  EXPECT_THAT(tried, ElementsAre("4"));
  room.context.recorded = false;
  cross = false;
  EXPECT_THAT(draped(), Not(HasSubstr("dressed")));
  EXPECT_THAT(tried, ElementsAre("4 may be given up"));
}

// Stopped before or after the second skirt is put on, it stays there, and is played again to the same bits.
TEST(Dressing, IsStoppedWhereItIs) {
  Workroom& room = drapingRoom();
  StopRequest* stop = nullptr;
  int steps = 0;
  bool later = false;
  room.context.drape = [&](const Document& d, const DrapePieces& drape, Context& own) {
    const bool counted = d.pattern.pieces.size() == (later ? 4u : 2u);
    return drapeOnBody(d, drape, own, [&, counted](const FormsNow&) {
      if (counted && ++steps == 5 && stop) stop->ask();
    });
  };
  for (const bool second : {false, true}) {
    DocumentFile file = DocumentFile::inMemory();
    ASSERT_TRUE(room.play(file, twoSkirts("6mm")));
    const Document hung = file.document();
    StopRequest request;
    later = second, steps = 0;
    room.context.stop = stop = &request;
    const auto step = file.perform(oneAfterAnother(), room.context);
    room.context.stop = stop = nullptr;
    ASSERT_TRUE(step) << text(step.error().what);
    EXPECT_GE(std::get<DrapePieces>(step->operation).stop, second ? 6 : 5);
    EXPECT_FALSE(file.document().drape.last->settled);
    EXPECT_EQ(file.document().drape.dirty.size(), 4u);
    room.context.recorded = true;
    const auto again = apply(hung, *parseOperation(text(step->operation)), room.context);
    room.context.recorded = false;
    ASSERT_TRUE(again);
    EXPECT_EQ(drapeHash(*again), step->stand) << second;
  }
}

// Flat pieces are moved as they are, those before the body together, as two fronts that lap; those behind it by
// themselves.
TEST(Dressing, FlatPiecesStandOffTogether) {
  Workroom& room = drapingRoom();
  DocumentFile file = DocumentFile::inMemory();
  const auto square = [](const std::string& name, const std::string& pose) {
    return "piece name=" + name + " outline=\"M 0 0; low L 200 0; out L 200 300; top L 0 300; in L 0 0\" pose=\"" +
           pose + "\"\n";
  };
  // The first stands in the skirt, the second beside it, the third well behind.
  const auto played = room.play(file, kSkirt + square("left", "-0.15,0.6,0.13") + square("right", "0.6,0.6,0.13") +
                                          square("behind", "0.15,0.6,-0.6 y 180deg"));
  ASSERT_TRUE(played) << text(played.error().what);
  const Document& before = file.document();
  const auto id = [&](const char* name) { return before.pieceNamed(name)->id; };
  const BodyPtr body = *bodyOf(before, room.context);
  const std::set<PieceId> worn{id("front"), id("back")}, fresh{id("left"), id("right"), id("behind")};
  const Document after = stoodOff(before, fresh, worn, *body);
  const auto moved = [&](const char* name) {
    return Stand(*after.find(id(name)))({0.1, 0.1}) - Stand(*before.find(id(name)))({0.1, 0.1});
  };
  EXPECT_GT(moved("left").z, 0.01);
  EXPECT_NEAR(length(moved("left") - moved("left").z * Vec3{0, 0, 1}), 0, 1e-9);
  EXPECT_NEAR(length(moved("left") - moved("right")), 0, 1e-12);
  EXPECT_NEAR(length(moved("behind")), 0, 1e-12);
  const Document again = stoodOff(after, fresh, worn, *body);  // it is clear now
  EXPECT_NEAR(length(Stand(*again.find(id("left")))({0, 0}) - Stand(*after.find(id("left")))({0, 0})), 0, 1e-12);
}

}  // namespace
}  // namespace karinui
