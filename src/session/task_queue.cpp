#include "session/task_queue.h"

#include <algorithm>

namespace karinui {

TaskQueue::TaskQueue(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

TaskQueue::~TaskQueue() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    waiting_.clear();
    if (running_) running_->cancel();
  }
  changed_.notify_all();
  thread_.join();
}

void TaskQueue::add(Kind kind, Work work) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({kind, std::move(work)});
  }
  changed_.notify_all();
}

void TaskQueue::cancel(Kind kind) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const Task& t) { return t.kind == kind; });
  if (running_ && runningKind_ == kind) running_->cancel();
}

bool TaskQueue::busy() const {
  const std::lock_guard lock(mutex_);
  return running_ || !waiting_.empty() || !finished_.empty();
}

bool TaskQueue::busy(Kind kind) const {
  const std::lock_guard lock(mutex_);
  return (running_ && runningKind_ == kind) ||
         std::any_of(waiting_.begin(), waiting_.end(), [&](const Task& t) { return t.kind == kind; }) ||
         std::any_of(finished_.begin(), finished_.end(), [&](const auto& done) { return done.first == kind; });
}

TaskQueue::Progress TaskQueue::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool TaskQueue::takeIn() {
  std::deque<std::pair<Kind, Finish>> taken;
  {
    const std::lock_guard lock(mutex_);
    taken.swap(finished_);
  }
  for (const auto& [kind, finish] : taken)
    if (finish) finish();
  return !taken.empty();
}

void TaskQueue::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !finished_.empty() || (!running_ && waiting_.empty()); });
}

void TaskQueue::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
    if (closing_) return;
    Task task = std::move(waiting_.front());
    waiting_.pop_front();
    running_ = std::make_shared<Token>([this](double fraction, const Message& doing) {
      {
        const std::lock_guard inner(mutex_);
        progress_ = {fraction, doing};
      }
      if (wake_) wake_();
    });
    runningKind_ = task.kind;
    progress_ = {};
    const std::shared_ptr<Token> token = running_;
    lock.unlock();
    Finish finish = task.work(*token);
    task.work = nullptr;  // what it held ends here, not under the lock
    lock.lock();
    finished_.emplace_back(task.kind, std::move(finish));
    running_.reset();
    changed_.notify_all();
    lock.unlock();
    if (wake_) wake_();
    lock.lock();
  }
}

}  // namespace karinui
