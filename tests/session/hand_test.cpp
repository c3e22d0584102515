// What a hand does quickly, and what it drops.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

void giveTwoPieces(Session& session) {
  const auto lines = parseScript(kTwoPieces);
  for (const ScriptLine& line : *lines) session.perform(line.operation);
  session.finish();
}

// A key that is held down asks again before the first copy is there.
TEST(SessionHand, CopiesAskedForAtOnceAreAllMade) {
  Session session;
  giveTwoPieces(session);
  Selection chosen;
  chosen.pieces = {session.snapshot().document.pieceNamed("front")->id};
  session.select(chosen);
  for (int k = 0; k < 3; ++k) session.command(Command::Duplicate);
  session.finish();
  for (const Notice& notice : session.takeNotices()) EXPECT_NE(notice.kind, Notice::Kind::Refused) << text(notice.what);
  for (const char* name : {"front_2", "front_3", "front_4"})
    EXPECT_TRUE(session.snapshot().document.pieceNamed(name)) << name;
}

// On the table a piece is only laid elsewhere, which is no step: what is dropped goes back by itself.
TEST(SessionHand, APieceCarriedOnTheTableGoesBackWhenItIsDropped) {
  for (const Command dropped : {Command::Cancel, Command::Undo}) {
    Session session;
    giveTwoPieces(session);
    const std::size_t steps = session.steps().size();
    const Piece front = *session.snapshot().document.pieceNamed("front");
    const Flat lay = session.table().at(front.id);
    const FlatBox box = boxOf(front.outline.flattened(1e-3));
    session.command(Command::Move);
    PointerSample hand;
    hand.where = PointerSample::Where::Table;
    hand.place = lay + lerp(box.low, box.high, 0.5);
    const auto feed = [&](PointerSample::Phase phase, Flat by) {
      hand.phase = phase;
      hand.place += by;
      session.feed(hand);
    };
    feed(PointerSample::Phase::Press, {});
    feed(PointerSample::Phase::Drag, {0.1, 0.05});
    feed(PointerSample::Phase::Drag, {0.2, -0.1});
    ASSERT_NEAR(session.table().at(front.id).u, lay.u + 0.3, 1e-9);
    session.command(dropped);
    EXPECT_NEAR(session.table().at(front.id).u, lay.u, 1e-9);
    EXPECT_NEAR(session.table().at(front.id).v, lay.v, 1e-9);
    EXPECT_FALSE(session.begun());
    session.finish();
    EXPECT_EQ(session.steps().size(), steps) << "nor is a step taken back";
    feed(PointerSample::Phase::Drag, {0.2, 0});  // the button is still down
    feed(PointerSample::Phase::Release, {});
    EXPECT_NEAR(session.table().at(front.id).u, lay.u, 1e-9);
    feed(PointerSample::Phase::Press, lay + lerp(box.low, box.high, 0.5) - hand.place);
    feed(PointerSample::Phase::Drag, {0.1, 0});
    feed(PointerSample::Phase::Release, {});
    EXPECT_NEAR(session.table().at(front.id).u, lay.u + 0.1, 1e-9) << "what is laid down stays";
  }
}

// A sleeve is sewn to itself under the arm: pulled there, the cloth on the other side of the seam comes along, and both
// edges are as long afterwards.
TEST(SessionHand, APullBesideAPiecesOwnSeamComesOverTheSeam) {
  Session session;
  const auto lines = parseScript(
      "piece name=sleeve outline=\"M 0 0; hem L 300 0; under_front L 310 300; cap L -10 310; under_back L 0 0\"\n"
      "sew a=sleeve.under_front b=sleeve.under_back");
  for (const ScriptLine& line : *lines) session.perform(line.operation);
  session.finish();
  const auto edge = [&](const char* name) {
    return findEdge(*session.snapshot().document.pieceNamed("sleeve"), name)->curve;
  };
  const double front = edge("under_front").length(), back = edge("under_back").length();
  session.command(Command::Reshape);
  PointerSample hand;
  hand.ray = {{0.28, 0.01, 2}, {0, 0, -1}};
  hand.reach = 0.005;
  const auto feed = [&](PointerSample::Phase phase, double down) {
    hand.phase = phase;
    hand.ray.origin.y -= down;
    session.feed(hand);
  };
  feed(PointerSample::Phase::Press, 0);
  feed(PointerSample::Phase::Drag, 0.02);
  feed(PointerSample::Phase::Drag, 0.02);
  feed(PointerSample::Phase::Release, 0);
  session.finish();
  const double longer = edge("under_front").length() - front;
  EXPECT_GT(longer, 0.015);
  EXPECT_NEAR(edge("under_back").length() - back, longer, 0.002);
}

// A hand that means an edge is as often a little beside the cloth as on it.
TEST(SessionHand, AnEdgeIsTakenHoldOfFromBesideTheCloth) {
  for (const double beside : {0.004, 0.3}) {
    Session session;
    giveTwoPieces(session);
    const std::size_t steps = session.steps().size();
    session.command(Command::Reshape);
    PointerSample hand;
    hand.ray = {{0.2, -beside, 2}, {0, 0, -1}};
    hand.reach = 0.005;
    for (const auto phase : {PointerSample::Phase::Press, PointerSample::Phase::Drag, PointerSample::Phase::Release}) {
      hand.phase = phase;
      session.feed(hand);
      hand.ray.origin.y -= phase == PointerSample::Phase::Press ? 0.03 : 0;
    }
    session.finish();
    EXPECT_EQ(session.steps().size(), steps + (beside < 0.01 ? 1 : 0)) << beside;
  }
}

}  // namespace
}  // namespace karinui
