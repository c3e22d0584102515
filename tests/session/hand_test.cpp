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

}  // namespace
}  // namespace karinui
