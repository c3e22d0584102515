#include "karinui/base/workers.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace karinui {
namespace {

constexpr int kSpins = 20000;    // some hundreds of microseconds: longer than the pause between two jobs of a solver
constexpr int kPatience = 1000;  // some ten: what it takes to fetch another's data
constexpr int kYield = 256;      // once in so many spins whoever else waits for the processor has it

void breathe(int spin) {
#if defined(__x86_64__) || defined(__i386__)
  if (spin % kYield != kYield - 1) return __builtin_ia32_pause();
#endif
  std::this_thread::yield();
}

}  // namespace

// Each of the team has its own share of the blocks, the same in every job of a size, so that it finds the data of the
// last job in its own cache; who is done helps the next. A solver's jobs are shorter than waking a thread:
// helpers look out for the next job a while before they sleep, and the caller waits only for helpers that took part,
// never for one that is still waking up. The counters are sequentially consistent: whoever enters either sees the job
// closed or is seen inside.
struct Workers::Team {
  struct Job {
    const std::function<void(std::size_t, std::size_t)>* work = nullptr;
    std::size_t block = 1;
  };
  struct alignas(64) Share {  // a cache line each
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  Job job;  // this and the shares are written only while it is closed and nobody is inside
  std::vector<Share> shares;
  std::vector<std::thread> helpers;
  std::atomic<std::uint64_t> number{0};
  std::atomic<bool> open{false}, closing{false};
  std::atomic<int> inside{0}, sleeping{0};
  std::mutex mutex;
  std::condition_variable begin;
  std::exception_ptr thrown;  // by the first block that did

  explicit Team(int threads) : shares(static_cast<std::size_t>(std::max(1, threads))) {}

  void share(std::size_t count) {
    const std::size_t blocks = (count + job.block - 1) / job.block, n = shares.size();
    for (std::size_t k = 0; k < n; ++k) {
      shares[k].next = k * blocks / n * job.block;
      shares[k].end = std::min((k + 1) * blocks / n * job.block, count);
    }
  }

  void share(std::span<const double> before) {
    const double each = before.back() / static_cast<double>(shares.size());
    const auto last = before.end() - 1;
    auto from = before.begin();
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const double wish = each * static_cast<double>(k + 1);
      auto to = k + 1 == shares.size() ? last : std::lower_bound(from, last, wish);
      if (to > from && to < last && wish - to[-1] < to[0] - wish) --to;
      shares[k].next = static_cast<std::size_t>(from - before.begin());
      shares[k].end = static_cast<std::size_t>(to - before.begin());
      from = to;
    }
  }

  // Has all shares' blocks done.
  void run(const std::function<void(std::size_t, std::size_t)>& work) {
    job.work = &work;
    open = true;
    ++number;
    wake();
    takeBlocks(0);
    open = false;
    for (int i = 0; inside != 0; ++i) breathe(i);
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
  }

  void takeBlocks(std::size_t me) noexcept {
    try {
      takeBlocksFrom(me);
    } catch (...) {
      for (Share& share : shares) share.next = share.end;  // the blocks that are left are left out
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  }

  void takeBlocksFrom(std::size_t me) {
    for (std::size_t k = 0; k < shares.size(); ++k) {
      Share& share = shares[(me + k) % shares.size()];
      for (int i = 0; k == 1 && i < kPatience && share.next.load(std::memory_order_relaxed) < share.end; ++i)
        breathe(i);
      for (;;) {
        const std::size_t from = share.next.fetch_add(job.block, std::memory_order_relaxed);
        if (from >= share.end) break;
        (*job.work)(from, std::min(from + job.block, share.end));
      }
    }
  }

  void help(std::size_t me) {
    std::uint64_t seen = 0;
    const auto called = [&] { return closing || number != seen; };
    for (;;) {
      for (int i = 0; i < kSpins && !called(); ++i) breathe(i);
      if (!called()) {
        std::unique_lock lock(mutex);
        ++sleeping;
        begin.wait(lock, called);
        --sleeping;
      }
      if (closing) return;
      seen = number;
      ++inside;
      if (open) takeBlocks(me);
      --inside;
    }
  }

  void wake() {
    if (sleeping == 0) return;
    { const std::lock_guard lock(mutex); }  // who is about to sleep does so first
    begin.notify_all();
  }
};

Workers::Workers(int threads) : team_(std::make_unique<Team>(threads)) {
  for (int i = 1; i < threads; ++i)
    team_->helpers.emplace_back([team = team_.get(), i] { team->help(static_cast<std::size_t>(i)); });
}

Workers::~Workers() {
  team_->closing = true;
  team_->wake();
  for (std::thread& helper : team_->helpers) helper.join();
}

int Workers::threads() const { return static_cast<int>(team_->helpers.size()) + 1; }

void Workers::forBlocks(std::size_t count, std::size_t block,
                        const std::function<void(std::size_t, std::size_t)>& work) {
  if (team_->helpers.empty() || count <= block) {
    for (std::size_t from = 0; from < count; from += block) work(from, std::min(from + block, count));
    return;
  }
  team_->job.block = block;
  team_->share(count);
  team_->run(work);
}

void Workers::forParts(std::span<const double> before, const std::function<void(std::size_t)>& work) {
  if (team_->helpers.empty() || before.size() <= 2) {
    for (std::size_t k = 0; k + 1 < before.size(); ++k) work(k);
    return;
  }
  team_->job.block = 1;
  team_->share(before);
  team_->run([&work](std::size_t k, std::size_t) { work(k); });
}

}  // namespace karinui
