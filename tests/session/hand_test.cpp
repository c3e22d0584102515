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

}  // namespace
}  // namespace karinui
