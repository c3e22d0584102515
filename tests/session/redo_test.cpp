// Undo goes back past steps that were changed, and redo forth again, to the very end.
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

std::vector<std::string> linesDone(const Session& session) {
  std::vector<std::string> all;
  for (const Step& step : session.steps()) all.push_back(text(step.operation));
  return all;
}

class Redo : public testing::Test {
 protected:
  Redo() : session(options()) {
    const auto lines = parseScript(kTwoPieces);
    for (const ScriptLine& line : *lines) session.perform(line.operation);
    session.finish();
  }
  SessionOptions options() {
    SessionOptions made;
    made.autoSettle = false;
    made.drape = room.context.drape;
    return made;
  }
  void move(const char* by) {
    session.perform(op((std::string("move piece=front by=0,0,") + by).c_str()));
    session.finish();
  }
  void amend(std::size_t which, const char* by) {
    session.amend(which, op((std::string("move piece=front by=0,0,") + by).c_str()));
    session.finish();
  }
  // As often as it can be, at most `most` times.
  int all(Command command, int most = 40) {
    int times = 0;
    for (; times < most && session.can(command); ++times) session.command(command), session.finish();
    return times;
  }
  Workroom room;
  Session session;
};

// A person types measures one by one, makes the garment, and types others for the next person.
TEST_F(Redo, WalksOnPastStepsThatWereChanged) {
  move("1cm");
  const std::size_t first = session.steps().size();
  amend(first, "2cm");
  amend(first, "3cm");
  move("4cm");
  move("5cm");
  amend(first + 1, "6cm");
  const auto last = linesDone(session);
  const int undone = all(Command::Undo);
  EXPECT_TRUE(session.steps().empty());
  EXPECT_EQ(undone, static_cast<int>(first) + 2 + 2 + 1);
  EXPECT_EQ(all(Command::Redo), undone);
  EXPECT_EQ(linesDone(session), last);
}

TEST_F(Redo, AfterOtherWorkThereIsTheOtherWorkOnly) {
  move("1cm");
  const std::size_t first = session.steps().size();
  amend(first, "2cm");
  move("3cm");
  for (int k = 0; k < 2; ++k) session.command(Command::Undo), session.finish();
  session.command(Command::Redo), session.finish();
  move("4cm");
  EXPECT_FALSE(session.can(Command::Redo));
  const auto now = linesDone(session);
  const int undone = all(Command::Undo);
  EXPECT_EQ(all(Command::Redo), undone);
  EXPECT_EQ(linesDone(session), now);
}

}  // namespace
}  // namespace karinui
