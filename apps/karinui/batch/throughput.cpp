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

// Of a plan: seconds it takes to make and to read, bytes of its manifest.
struct PlanCost {
  std::size_t items = 0;
  double made = 0, read = 0, bytes = 0;
};

// Of so many people, those of the table over and over, each a little other than the rest, for two of the same are
// planned once.
Result<PlanCost> planned(BatchWish batch, const std::string& table, std::size_t known, std::size_t people,
                         const fs::path& folder) {
  const std::size_t rows = std::min(table.size(), table.find('\n') + 1);
  std::string longer = table;
  for (std::size_t have = known; have < people; have += known) {
    if (longer.back() != '\n') longer += '\n';
    longer.append(table, rows);
  }
  batch.folder = folder;
  PlanCost cost;
  Done done;
  cost.made = timed(
      [&]() -> Done {
        auto read = readMeasurementTable(longer);
        if (!read) return read.error();
        read->people.resize(std::min(people, read->people.size()));
        double tenths = 0;  // of a millimetre, so that numbers stay short
        for (MeasuredPerson& person : read->people)
          if (auto& all = person.measures.value; !all.empty())
            all.begin()->second = std::round(1e4 * all.begin()->second + tenths++) / 1e4;
        const auto plan = planBatch(batch, read->people);
        if (!plan) return plan.error();
        cost.items = plan->items.size();
        return {};
      },
      done);
  if (!done) return done.error();
  cost.read = timed(
      [&]() -> Done {
        const auto again = readPlan(folder);
        return again ? Done() : again.error();
      },
      done);
  if (!done) return done.error();
  cost.bytes = bytesOf(folder / "manifest.json");
  return cost;
}

// The plan, made and read, of few people and of many: what does not grow with them (the program's hash, the designs) is
// told from what does.
Done measurePlan(const BatchWish& batch, const BatchPlan& plan, const fs::path& scratch, Throughput& found) {
  const auto table = readFile(batch.bodies);
  if (!table) return table.error();
  const std::size_t known = plan.bodies.size(), perPerson = std::max<std::size_t>(1, plan.items.size() / known);
  constexpr std::size_t kFew = 200, kMany = 10'000;  // items
  const auto costOf = [&](std::size_t items, const char* name) {
    return planned(batch, *table, known, items / perPerson + 1, scratch / name);
  };
  const auto few = costOf(kFew, "few"), many = costOf(kMany, "many");
  if (!few) return few.error();
  if (!many) return many.error();
  const double more = std::fmax(1, static_cast<double>(many->items) - static_cast<double>(few->items));
  const auto slope = [&](double PlanCost::*what) { return std::fmax(0, (*many.*what - *few.*what) / more); };
  found.plan = slope(&PlanCost::made);
  found.fixed = std::fmax(0, few->made - found.plan * static_cast<double>(few->items));
  found.read = slope(&PlanCost::read);
  found.manifest = slope(&PlanCost::bytes);
  return {};
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

  const auto plan = planBatch(batch, program.console);
  if (!plan) return plan.error();
  if (done = measurePlan(batch, *plan, scratch.path(), found); !done) return done.error();

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
