#include "throughput.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <thread>

#include "karinui/base/file.h"
#include "shard.h"
#include "table.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

// A folder of its own, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::error_code trouble;
    std::string pattern = (fs::temp_directory_path(trouble) / "karinui-batch-XXXXXX").string();
    if (::mkdtemp(pattern.data())) path_ = pattern;
  }
  ~Scratch() {
    std::error_code trouble;
    if (!path_.empty()) fs::remove_all(path_, trouble);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double cpuOf(int who) {  // RUSAGE_SELF or RUSAGE_CHILDREN
  rusage used{};
  ::getrusage(who, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}
double largestChild() {  // MB
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_maxrss) / 1024;
}

double timed(const std::function<Done()>& work, Done& done) {
  const double began = cpuOf(RUSAGE_SELF);
  done = work();
  return cpuOf(RUSAGE_SELF) - began;
}

double bytesOf(const fs::path& file) {
  std::error_code trouble;
  const auto size = fs::file_size(file, trouble);
  return trouble ? 0 : static_cast<double>(size);
}

}  // namespace

Result<Throughput> measureThroughput(Program& program, const ThroughputWish& wish) {
  const Scratch scratch;
  if (scratch.path().empty())
    return storageError(
        say("“{0}” could not be written: {1}", fs::temp_directory_path().string(), std::strerror(errno)));
  Throughput found;
  found.processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  BatchWish batch = wish.batch;
  batch.folder = scratch.path() / "run";
  Done done;
  const auto each = [](double seconds, std::size_t count) { return seconds / static_cast<double>(count); };

  // The plan, made and read. Both begin with the hash of the program, which does not grow.
  Result<BatchPlan> plan = refused(Message());
  const double planned =
      timed([&] { return (plan = planBatch(batch, program.console)) ? Done() : plan.error(); }, done);
  if (!done) return done.error();
  found.fixed = timed([&] { return madeByThisProgram(*plan); }, done);
  const double read = timed(
      [&] {
        const auto again = readPlan(batch.folder);
        return again ? Done() : again.error();
      },
      done);
  if (!done) return done.error();
  found.plan = each(std::fmax(0, planned - found.fixed), plan->items.size());
  found.read = each(read, plan->items.size());
  found.manifest = each(bytesOf(batch.folder / "manifest.json"), plan->items.size());

  // The same garments alone, and one on every processor.
  ShardWish shard;
  shard.shards = std::max<std::size_t>(1, plan->items.size() / std::max<std::size_t>(1, wish.sample));
  shard.seconds = wish.seconds;
  const int threads = std::exchange(program.threads, 1);
  const auto make = [&](int jobs) -> Result<double> {
    program.threads = shard.jobs = jobs;
    const double before = cpuOf(RUSAGE_CHILDREN);
    const auto made = runShard(program, batch.folder, shard);
    if (!made) return made.error();
    found.sample = made->done;
    return each(cpuOf(RUSAGE_CHILDREN) - before, found.sample);
  };
  const auto began = std::chrono::steady_clock::now();
  const Result<double> alone = make(1);
  if (!alone) return program.threads = threads, alone.error();
  found.alone = *alone;
  found.clock = each(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), found.sample);
  for (std::size_t i = 0; i < plan->items.size(); i += shard.shards) {
    const BatchItem& item = plan->items[i];
    found.out += each(bytesOf(itemFile(batch.folder, item)), found.sample);
    found.in +=
        each(bytesOf(batch.folder / plan->designs[item.design].file) + static_cast<double>(planOf(*plan, item).size()),
             found.sample);
  }

  // The table: a row for every garment that was made, over and over, so that the clock tells something.
  constexpr std::size_t kRows = 1000;
  BatchPlan part = *plan, one = *plan;
  part.items.clear();
  for (std::size_t i = 0; i < plan->items.size(); i += shard.shards) part.items.push_back(plan->items[i]);
  one.items.resize(1);
  const auto merged = [&](const BatchPlan& of) -> Done {
    const BatchTable table = tableOf(of, batch.folder);
    if (const Done kept = writeFile(batch.folder / "table.csv", asCsv(table)); !kept) return kept;
    return writeDatabase(table, batch.folder / "table.sqlite");
  };
  BatchPlan many = part;
  while (many.items.size() < kRows) many.items.push_back(part.items[many.items.size() % part.items.size()]);
  const double little = timed([&] { return merged(one); }, done);
  if (!done) return done.error();
  const double whole = timed([&] { return merged(many); }, done);
  if (!done) return done.error();
  found.merge = each(std::fmax(0, whole - little), many.items.size() - 1);
  found.fixed += little;

  for (const BatchItem& item : part.items) {
    std::error_code trouble;
    fs::remove(itemFile(batch.folder, item), trouble);
  }
  const Result<double> beside = make(found.processors);
  program.threads = threads;
  if (!beside) return beside.error();
  found.beside = *beside;
  found.megabytes = largestChild();
  return found;
}

BatchTime timeOf(const Throughput& measured, double garments, double cores) {
  return {measured.fixed + measured.plan * garments,
          measured.read * garments + std::ceil(garments / cores) * measured.beside, measured.merge * garments};
}

}  // namespace karinui::app
