// The n-th piece of memory that is asked for is not given, for n = 1, 2, 3 … until all went well: what was refused
// changed nothing, what was acknowledged is in the file, and the same document works on. Every allocation of ours and
// of SQLite's counts. ./test tries some of them, ./test --long each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <new>
#include <random>

#include "design/allocations.h"
#include "design/quick_folder.h"
#include "design/workroom.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::Not;

class FailingMemory : public ::testing::Test {
 protected:
  FailingMemory() {
    folder_ = quickFolder();
    sqlite3_shutdown();
    sqlite3_config(SQLITE_CONFIG_GETMALLOC, &usual_);
    sqlite3_mem_methods ours = usual_;
    real_ = usual_;
    ours.xMalloc = [](int size) { return shortage().strikes() ? nullptr : real_.xMalloc(size); };
    ours.xRealloc = [](void* old, int size) { return shortage().strikes() ? nullptr : real_.xRealloc(old, size); };
    EXPECT_EQ(sqlite3_config(SQLITE_CONFIG_MALLOC, &ours), SQLITE_OK);
    sqlite3_initialize();
  }
  ~FailingMemory() override {
    sqlite3_shutdown();
    sqlite3_config(SQLITE_CONFIG_MALLOC, &usual_);
    sqlite3_initialize();
    fs::remove_all(folder_);
  }

  static std::string stateOf(const Document& document) { return hash(document) + drapeHash(document); }
  static std::string stateOf(const DocumentFile& file) { return stateOf(file.document()) + file.log(); }

  static std::vector<std::string> remarks(const DocumentFile& file) {
    std::vector<std::string> all;
    for (const Message& remark : file.remarks()) all.push_back(text(remark));
    return all;
  }

  // Runs one thing with the shortage on; false: it was refused, or there was no room even for the sentence.
  template <class Work>
  static bool during(const Work& work) {
    bool done = false;
    Message why;
    shortage().on = true;
    try {
      auto result = work();
      done = static_cast<bool>(result);
      if (!done) why = result.error().what;
    } catch (const std::bad_alloc&) {
      shortage().on = false;
      return false;
    }
    shortage().on = false;
    EXPECT_TRUE(done || !text(why).empty());
    EXPECT_TRUE(done || shortage().from > 0) << text(why);
    return done;
  }

  // An afternoon with the allocations from n to `last` failing: how many there were.
  long work(long n, long last) {
    fs::remove(path_);
    fs::copy_file(folder_ / "begun", path_);
    shortage().asked = 0, shortage().from = n, shortage().to = last;
    std::string acknowledged = begun_;
    std::optional<DocumentFile> file;
    during([&] {
      auto opened = DocumentFile::open(path_, &room_.context);
      if (opened) file.emplace(*std::move(opened));
      return opened ? Done() : Done(opened.error());
    });
    if (file) {
      EXPECT_EQ(stateOf(*file), begun_);
      EXPECT_THAT(remarks(*file), IsEmpty());
      const auto step = [&](const std::function<Done()>& what) {
        const std::string before = stateOf(*file);
        const bool done = during(what);
        if (done) acknowledged = stateOf(*file);
        EXPECT_TRUE(done || stateOf(*file) == before) << "refused, yet changed";
        return done;
      };
      const auto perform = [&](const char* line) {
        const Operation operation = *parseOperation(line);
        return step([&] { return told(file->perform(operation, room_.context)); });
      };
      perform("sew a=front.side_left b=back.side_left");
      perform("drape");
      step([&] { return told(file->undo(room_.context)); });
      step([&] { return told(file->redo(room_.context)); });
      step([&] { return file->goTo(2, room_.context); });
      perform("move piece=front by=0.1,0,0");
      const Operation other = *parseOperation("move piece=front by=0.2,0,0");
      step([&] { return file->steps().size() == 3 ? file->amend(3, other, room_.context) : Done(); });
      const std::string counted = stateOf(*file);
      // Memory is there again: the same document works on.
      const auto after = file->perform(*parseOperation("move piece=back by=0,0.1,0"), room_.context);
      EXPECT_TRUE(after) << text(after.error().what);
      EXPECT_NE(stateOf(*file), counted);
      if (after) acknowledged = stateOf(*file);
    }
    const long asked = shortage().asked;
    file.reset();
    const auto again = DocumentFile::open(path_);  // nothing has to be made again
    EXPECT_TRUE(again) << text(again.error().what);
    if (!again) return asked;
    EXPECT_EQ(stateOf(*again), acknowledged);
    EXPECT_THAT(remarks(*again), IsEmpty());
    return asked;
  }
  static Done told(const Result<Step>& step) { return step ? Done() : Done(step.error()); }

  void SetUp() override {
    auto file = DocumentFile::create(folder_ / "begun");
    ASSERT_TRUE(file && room_.play(*file, kTwoPieces));
    begun_ = stateOf(*file);
  }

  static inline sqlite3_mem_methods real_{};
  sqlite3_mem_methods usual_{};
  fs::path folder_, path_;
  Workroom room_;
  std::string begun_;
};

TEST_F(FailingMemory, WhatWasAcknowledgedIsThereWhicheverAllocationFails) {
  path_ = folder_ / "coat.karinui";
  const long all = work(0, 0);
  ASSERT_GT(all, 1000);
  const bool each = soak(1) > 1;
  std::mt19937_64 dice(20261124);
  // Each alone; a second without any; and never again.
  for (const long more : {0L, 200L, 1'000'000'000L}) {
    const long stride = each ? 1 : all / 400;
    for (long n = 1; n <= all; n += each ? 1 : 1 + static_cast<long>(dice() % (2 * stride))) {
      SCOPED_TRACE("allocation " + std::to_string(n) + " of " + std::to_string(all) + ", and " + std::to_string(more));
      work(n, n + more);
      if (HasFailure()) return;
    }
  }
}

// A curtain is brought to rest by the solver itself, two threads at work.
TEST_F(FailingMemory, ADrapeWithoutMemoryIsRefusedWhole) {
  Workers two(2);
  const Token token;
  Bodies bodies;
  auto file = DocumentFile::inMemory();
  Context context{two, token, file.blobs(), bodies, {}, {}};
  ASSERT_TRUE(file.perform(SetBody{{}, {}, {}, false, *file.blobs().put(packBody(egg()))}, context));
  for (const char* line :
       {"set spacing=40mm",
        "piece name=curtain outline=\"M 0 0; hem L 200 0; r L 200 200; top L 0 200; l L 0 0\" pose=\"0,0,0.5\"",
        "pin edge=curtain.top"}) {
    const auto done = file.perform(*parseOperation(line), context);
    ASSERT_TRUE(done) << text(done.error().what);
  }
  const std::string before = stateOf(file);
  const auto drape = [&](long from, long to) {
    shortage().asked = 0, shortage().from = from, shortage().to = to;
    return during([&] { return told(file.perform(Operation(DrapePieces()), context)); });
  };
  ASSERT_TRUE(drape(0, 0));
  const std::string draped = stateOf(file);
  const long all = shortage().asked;
  ASSERT_TRUE(file.undo(context));
  std::mt19937_64 dice(20261125);
  for (int run = 0, runs = soak(30); run < runs; ++run) {
    const long n = 1 + static_cast<long>(dice() % static_cast<std::uint64_t>(all));
    SCOPED_TRACE("allocation " + std::to_string(n) + " of " + std::to_string(all));
    if (drape(n, run % 2 == 0 ? n : n + 1'000'000'000)) {
      EXPECT_EQ(stateOf(file), draped);
      ASSERT_TRUE(file.undo(context));
    }
    ASSERT_EQ(stateOf(file), before);
  }
  ASSERT_TRUE(drape(0, 0));
  EXPECT_EQ(stateOf(file), draped) << "nothing of what failed is left";
}

}  // namespace
}  // namespace karinui
