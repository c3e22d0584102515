#include "karinui/base/workers.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace karinui {

// Helpers sleep until a job's number changes; blocks are handed out by a counter, so a slow block delays nobody.
struct Workers::Team {
  struct Job {
    const std::function<void(std::size_t, std::size_t)>* work = nullptr;
    std::size_t count = 0, block = 1;
    std::atomic<std::size_t> next{0};
  };
  Job job;
  std::vector<std::thread> helpers;
  std::mutex mutex;
  std::condition_variable begin, end;
  std::uint64_t number = 0;
  std::size_t busy = 0;
  bool closing = false;

  void takeBlocks() {
    for (;;) {
      const std::size_t from = job.next.fetch_add(job.block, std::memory_order_relaxed);
      if (from >= job.count) return;
      (*job.work)(from, std::min(from + job.block, job.count));
    }
  }

  void help() {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    for (;;) {
      begin.wait(lock, [&] { return closing || number != seen; });
      if (closing) return;
      seen = number;
      lock.unlock();
      takeBlocks();
      lock.lock();
      if (--busy == 0) end.notify_one();
    }
  }
};

Workers::Workers(int threads) : team_(std::make_unique<Team>()) {
  for (int i = 1; i < threads; ++i) team_->helpers.emplace_back([team = team_.get()] { team->help(); });
}

Workers::~Workers() {
  {
    std::lock_guard lock(team_->mutex);
    team_->closing = true;
  }
  team_->begin.notify_all();
  for (std::thread& helper : team_->helpers) helper.join();
}

int Workers::threads() const { return static_cast<int>(team_->helpers.size()) + 1; }

void Workers::forBlocks(std::size_t count, std::size_t block,
                        const std::function<void(std::size_t, std::size_t)>& work) {
  if (team_->helpers.empty() || count <= block) {
    for (std::size_t from = 0; from < count; from += block) work(from, std::min(from + block, count));
    return;
  }
  {
    std::lock_guard lock(team_->mutex);
    team_->job.work = &work;
    team_->job.count = count;
    team_->job.block = block;
    team_->job.next = 0;
    team_->busy = team_->helpers.size();
    ++team_->number;
  }
  team_->begin.notify_all();
  team_->takeBlocks();
  std::unique_lock lock(team_->mutex);
  team_->end.wait(lock, [&] { return team_->busy == 0; });
}

}  // namespace karinui
