#include "session/task_queue.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

namespace karinui {
namespace {

TEST(TaskQueue, CancelsWhatRunsAndDropsWhatWaits) {
  TaskQueue line({});
  std::promise<void> begun;
  int ended = 0;
  bool stopped = false;
  line.add(TaskQueue::Kind::Settle, [&](const Token& token) -> TaskQueue::Finish {
    begun.set_value();
    while (!token.cancelled()) std::this_thread::yield();
    stopped = true;
    return [&] { ++ended; };
  });
  line.add(TaskQueue::Kind::Settle, [&](const Token&) -> TaskQueue::Finish { return [&] { ended += 100; }; });
  begun.get_future().wait();
  EXPECT_TRUE(line.busy(TaskQueue::Kind::Settle));
  line.cancel(TaskQueue::Kind::Settle);
  while (line.busy()) {
    line.wait();
    line.takeIn();
  }
  EXPECT_TRUE(stopped);
  EXPECT_EQ(ended, 1);
}

// What is done and not yet taken in still changes what is under the hand.
TEST(TaskQueue, IsBusyUntilWhatFinishedIsTakenIn) {
  TaskQueue line({});
  line.add(TaskQueue::Kind::Step, [](const Token&) { return TaskQueue::Finish(); });
  line.wait();
  EXPECT_TRUE(line.busy(TaskQueue::Kind::Step));
  EXPECT_FALSE(line.busy(TaskQueue::Kind::Settle));
  line.takeIn();
  EXPECT_FALSE(line.busy(TaskQueue::Kind::Step));
}

}  // namespace
}  // namespace karinui
