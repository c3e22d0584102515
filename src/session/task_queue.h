#pragma once
// One thread beside the hand's, that does long work piece by piece. What a task finds out comes back to the owner's
// thread, when the owner asks for it.
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "karinui/base/token.h"

namespace karinui {

class TaskQueue {
 public:
  enum class Kind { Step, Pose, Settle, Preview, SettlePreview, Figure, SnapshotAfter };
  using Finish = std::function<void()>;              // runs on the owner's thread
  using Work = std::function<Finish(const Token&)>;  // runs on the worker thread
  struct Progress {
    double fraction = 0;
    Message doing;
  };

  // `wake` is called from the worker thread whenever there is something to take in; it must be quick.
  explicit TaskQueue(std::function<void()> wake);
  ~TaskQueue();  // asks what runs to stop, and waits for that

  void add(Kind kind, Work work);
  void cancel(Kind kind);      // drops what waits, asks what runs to stop
  bool busy() const;           // something runs, waits, or has not been taken in
  bool busy(Kind kind) const;  // the same of one kind
  Progress progress() const;
  bool takeIn();  // runs what finished; false: nothing had
  void wait();    // until something can be taken in or nothing is left to do

 private:
  struct Task {
    Kind kind;
    Work work;
  };
  void run();

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> waiting_;
  std::deque<std::pair<Kind, Finish>> finished_;
  std::shared_ptr<Token> running_;
  Kind runningKind_ = Kind::Step;
  Progress progress_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace karinui
