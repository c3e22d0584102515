#include "shard.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "item.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A child at work on an item. It goes when this process does.
class Worker {
 public:
  static Result<Worker> start(const fs::path& folder, const BatchPlan& plan, const BatchItem& item, int threads,
                              int seconds, int attempt = 1) {
    const std::string folderText = folder.string(), threadsText = std::to_string(threads);
    const char* const words[] = {
        "karinui", "batch", "item", folderText.c_str(), item.key.c_str(), "--threads", threadsText.c_str(), nullptr};
    const pid_t parent = ::getpid();
    const auto none = [] { return storageError(say("No process could be started: {0}.", std::strerror(errno))); };
    int given[2];
    if (::pipe2(given, O_CLOEXEC) != 0) return none();
    const int heard = ::memfd_create("said", MFD_CLOEXEC);  // a pipe would have to be read while it works
    const pid_t pid = ::fork();
    if (pid < 0) return ::close(given[0]), ::close(given[1]), ::close(heard), none();
    if (pid == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(127);
      const rlimit nothing{0, 0};
      ::setrlimit(RLIMIT_CORE, &nothing);
      ::dup2(given[0], STDIN_FILENO);
      if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
      if (heard >= 0) ::dup2(heard, STDERR_FILENO);
      ::execv("/proc/self/exe", const_cast<char* const*>(words));
      ::_exit(127);
    }
    const std::string one = planOf(plan, item);  // a few thousand bytes, which a pipe holds; no waiting for more room
    ::fcntl(given[1], F_SETFL, O_NONBLOCK);
    const bool written = ::write(given[1], one.data(), one.size()) == static_cast<ssize_t>(one.size());
    ::close(given[0]), ::close(given[1]);
    if (!written) return ::kill(pid, SIGKILL), ::waitpid(pid, nullptr, 0), ::close(heard), none();
    return Worker(item, pid, heard, Clock::now() + std::chrono::seconds(seconds), attempt);
  }
  Worker(Worker&& other) noexcept
      : item_(other.item_),
        pid_(std::exchange(other.pid_, -1)),
        watch_(std::exchange(other.watch_, -1)),
        heard_(std::exchange(other.heard_, -1)),
        until_(other.until_),
        attempt_(other.attempt_) {}
  Worker& operator=(Worker&& other) noexcept {
    std::swap(item_, other.item_), std::swap(pid_, other.pid_), std::swap(watch_, other.watch_),
        std::swap(heard_, other.heard_), std::swap(until_, other.until_), std::swap(attempt_, other.attempt_);
    return *this;
  }
  ~Worker() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
    if (watch_ >= 0) ::close(watch_);
    if (heard_ >= 0) ::close(heard_);
  }

  const BatchItem& item() const { return *item_; }
  int attempt() const { return attempt_; }  // from 1
  int watch() const { return watch_; }
  Clock::time_point until() const { return until_; }
  bool outOfTime() const { return Clock::now() >= until_; }
  void kill() { ::kill(pid_, SIGKILL); }
  // Its status, once it has ended.
  std::optional<int> ended() {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
    pid_ = -1;
    return status;
  }
  // The last line it said on stderr; of a long one its end.
  std::string lastWords() const {
    char bytes[2000];
    const off_t end = ::lseek(heard_, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, end - static_cast<off_t>(sizeof bytes));
    const ssize_t got = end > 0 ? ::pread(heard_, bytes, static_cast<std::size_t>(end - from), from) : 0;
    std::string_view said(bytes, static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    while (!said.empty() && said.back() == '\n') said.remove_suffix(1);
    said.remove_prefix(said.rfind('\n') + 1);  // npos + 1 is 0
    constexpr std::string_view kOurs = "karinui: ";
    if (said.starts_with(kOurs)) said.remove_prefix(kOurs.size());
    return std::string(said);
  }

 private:
  Worker(const BatchItem& item, pid_t pid, int heard, Clock::time_point until, int attempt)
      : item_(&item),
        pid_(pid),
        watch_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))),
        heard_(heard),
        until_(until),
        attempt_(attempt) {}
  const BatchItem* item_;
  pid_t pid_;
  int watch_;
  int heard_;  // what it says on stderr
  Clock::time_point until_;
  int attempt_;
};

void waitForAny(const std::vector<Worker>& workers) {
  std::vector<pollfd> watched;
  Clock::time_point until = Clock::now() + std::chrono::seconds(60);
  for (const Worker& worker : workers) {
    watched.push_back({worker.watch(), POLLIN, 0});
    until = std::min(until, worker.until());
  }
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count() + 1;
  ::poll(watched.data(), watched.size(), static_cast<int>(std::clamp<long>(left, 1, 60'000)));
}

bool hindered(const Json& known) {
  const Json& outcome = known.at("outcome");
  return outcome == nameOf(Outcome::Crashed) || outcome == nameOf(Outcome::OutOfMemory) ||
         outcome == nameOf(Outcome::Timeout);
}
bool worthRetrying(const Json& known, const ShardWish& wish) {
  if (!hindered(known)) return false;
  if (known.at("outcome") != nameOf(Outcome::Timeout)) return true;
  const Json seconds = known.value("seconds", Json(0));
  return !(seconds.is_number_integer() && seconds.get<int>() >= wish.seconds);
}

// What kept an item from having an outcome lies in this machine, and would stand in the way of the next ones too.
Error endedOtherwise(const BatchPlan& plan, const BatchItem& item, const std::string& lastWords, int status) {
  const std::string &design = plan.designs[item.design].name, &person = plan.bodies[item.body].name;
  if (lastWords.empty())
    return storageError(say("{0} on {1} ended with status {2} and said nothing.", design, person, status));
  return storageError(say("{0} on {1}: {2}", design, person, lastWords));
}

}  // namespace

Result<std::pair<std::size_t, std::size_t>> parseShard(const std::string& text) {
  std::size_t shard = 0, shards = 0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto first = std::from_chars(begin, end, shard);
  const auto second = first.ptr != end && *first.ptr == '/'
                          ? std::from_chars(first.ptr + 1, end, shards)
                          : std::from_chars_result{begin, std::errc::invalid_argument};
  if (second.ec != std::errc() || second.ptr != end || shard < 1 || shard > shards || shards > 100'000)
    return badInput(say("“{0}” is no part of a batch; write 2/5 for the second of five.", text));
  return std::pair(shard, shards);
}

Result<ShardDone> runShard(Program& program, const fs::path& folder, const ShardWish& wish) {
  const auto plan = readPlan(folder);
  if (!plan) return plan.error();
  if (const Done same = madeByThisProgram(*plan); !same) return same.error();
  ShardDone done;
  std::vector<const BatchItem*> waiting;
  for (std::size_t i = wish.shard - 1; i < plan->items.size(); i += wish.shards) {
    const Json known = itemOutcome(folder, plan->items[i]);
    const bool again = known.is_object() && wish.retry && worthRetrying(known, wish);
    ++done.items;
    if (known.is_object() && !again)
      ++done.before, done.hindered += hindered(known);
    else
      waiting.push_back(&plan->items[i]);
  }
  const auto told = [&](const BatchItem& item, const Message& outcome) {
    program.console.note(say("{0} of {1}: {2} on {3}: {4}", done.before + done.done, done.items,
                             plan->designs[item.design].name, plan->bodies[item.body].name, outcome));
  };
  const int threads = std::max(1, program.threads / wish.jobs);
  std::vector<Worker> working;
  const Token& token = program.console.token();
  for (std::size_t next = 0; next < waiting.size() || !working.empty();) {
    if (token.cancelled()) return cancelled();  // what is at work is dropped, and done when the batch goes on
    if (next < waiting.size() && working.size() < static_cast<std::size_t>(wish.jobs)) {
      auto worker = Worker::start(folder, *plan, *waiting[next++], threads, wish.seconds);
      if (!worker) return worker.error();
      working.push_back(*std::move(worker));
      continue;
    }
    waitForAny(working);
    for (std::size_t i = 0; i < working.size();) {
      Worker& worker = working[i];
      const std::optional<int> status = worker.ended();
      if (!status && !worker.outOfTime()) {
        ++i;
        continue;
      }
      const BatchItem& item = worker.item();
      const bool starved = status && WIFEXITED(*status) && WEXITSTATUS(*status) == kItemOutOfMemory;
      if (status && (WIFSIGNALED(*status) || starved) && worker.attempt() < wish.attempts) {
        auto another = Worker::start(folder, *plan, item, threads, wish.seconds, worker.attempt() + 1);
        if (!another) return another.error();
        worker = *std::move(another);
        continue;
      }
      Done kept;
      if (!status) {
        kept = keepOutcome(folder, item, Outcome::Timeout, say("Not done after {0} s.", wish.seconds), Json::object(),
                           wish.seconds);
      } else if (WIFSIGNALED(*status)) {
        kept = keepOutcome(folder, item, Outcome::Crashed,
                           say("The program fell down: {0}.", ::strsignal(WTERMSIG(*status))));
      } else if (starved) {
        kept = keepOutcome(folder, item, Outcome::OutOfMemory, outOfMemory().what);
      } else if (WEXITSTATUS(*status) != kDone) {
        return endedOtherwise(*plan, item, worker.lastWords(), WEXITSTATUS(*status));
      }
      if (!kept) return kept.error();
      ++done.done;
      const Json outcome = itemOutcome(folder, item);
      if (!outcome.is_object())
        return storageError(say("What was written to “{0}” is not there to be read again; does its disk fail?",
                                itemFile(folder, item).string()));
      done.hindered += hindered(outcome);
      told(item, outcomeSaid(outcome));
      working.erase(working.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return done;
}

}  // namespace karinui::app
