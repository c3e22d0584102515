// The n-th call to the disk fails, for n = 1, 2, 3 … until all went well: the file opens, and what was acknowledged is
// there. Of steps that were refused since only the disk knows: one is there whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <set>

#include "design/workroom.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

// SQLite's file layer, with a fault in it.
struct Fault {
  int calls = 0;         // that change something on the disk
  int failing = 0;       // the one that fails; 0: none
  bool forever = false;  // and all that follow
  int code = SQLITE_IOERR_WRITE;
  bool fails() {
    ++calls;
    return failing > 0 && (forever ? calls >= failing : calls == failing);
  }
} fault;

sqlite3_vfs* real = nullptr;

struct File {
  sqlite3_file base;
  sqlite3_file* whole() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};
File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }

const sqlite3_io_methods kMethods = [] {
  sqlite3_io_methods m{};
  m.iVersion = 1;
  m.xClose = [](sqlite3_file* f) { return of(f).whole()->pMethods->xClose(of(f).whole()); };
  m.xRead = [](sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
    return of(f).whole()->pMethods->xRead(of(f).whole(), to, size, at);
  };
  m.xWrite = [](sqlite3_file* f, const void* from, int size, sqlite3_int64 at) {
    if (!fault.fails()) return of(f).whole()->pMethods->xWrite(of(f).whole(), from, size, at);
    // Some of its sectors come to the disk.
    if (const int half = size / 1024 * 512; half > 0)
      (void)of(f).whole()->pMethods->xWrite(of(f).whole(), from, half, at);
    return fault.code;
  };
  m.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
    return fault.fails() ? fault.code : of(f).whole()->pMethods->xTruncate(of(f).whole(), size);
  };
  m.xSync = [](sqlite3_file*, int) { return fault.fails() ? SQLITE_IOERR_FSYNC : SQLITE_OK; };  // no power is cut here
  m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
    return of(f).whole()->pMethods->xFileSize(of(f).whole(), size);
  };
  m.xLock = [](sqlite3_file* f, int how) { return of(f).whole()->pMethods->xLock(of(f).whole(), how); };
  m.xUnlock = [](sqlite3_file* f, int how) { return of(f).whole()->pMethods->xUnlock(of(f).whole(), how); };
  m.xCheckReservedLock = [](sqlite3_file* f, int* is) {
    return of(f).whole()->pMethods->xCheckReservedLock(of(f).whole(), is);
  };
  m.xFileControl = [](sqlite3_file* f, int what, void* with) {
    return of(f).whole()->pMethods->xFileControl(of(f).whole(), what, with);
  };
  m.xSectorSize = [](sqlite3_file* f) { return of(f).whole()->pMethods->xSectorSize(of(f).whole()); };
  m.xDeviceCharacteristics = [](sqlite3_file*) { return 0; };
  return m;
}();

class FailingDisk : public ::testing::Test {
 protected:
  FailingDisk() {
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    sqlite3_initialize();
    real = sqlite3_vfs_find(nullptr);
    layer_ = *real;
    layer_.zName = "failing";
    layer_.szOsFile = static_cast<int>(sizeof(File)) + real->szOsFile;
    layer_.xOpen = [](sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* got) {
      file->pMethods = nullptr;
      std::memset(of(file).whole(), 0, static_cast<std::size_t>(real->szOsFile));
      if ((flags & SQLITE_OPEN_CREATE) != 0 && fault.fails()) return SQLITE_CANTOPEN;
      const int done = real->xOpen(real, path, of(file).whole(), flags, got);
      if (of(file).whole()->pMethods) file->pMethods = &kMethods;
      return done;
    };
    layer_.xDelete = [](sqlite3_vfs*, const char* path, int sync) {
      return fault.fails() ? SQLITE_IOERR_DELETE : real->xDelete(real, path, sync);
    };
    fault = {};
    EXPECT_EQ(sqlite3_vfs_register(&layer_, 1), SQLITE_OK);
  }
  ~FailingDisk() override {
    sqlite3_vfs_unregister(&layer_);
    sqlite3_vfs_register(real, 1);
    fs::remove_all(folder_);
  }

  static std::string stateOf(const Document& document) { return hash(document) + drapeHash(document); }
  // What the step would have led to.
  Result<Document> after(DocumentFile& file, const std::string& line) {
    if (line == "undo") return file.documentAfter(file.steps().back().parent, room_.context);
    if (line == "redo" && file.undone().empty()) return refused({});
    if (line == "redo") return file.documentAfter(file.undone().front().seq, room_.context);
    return apply(file.document(), *parseOperation(line), room_.context);
  }

  // An afternoon's steps with the n-th call failing. What was told to be done must be there afterwards.
  void work(int n, bool forever, int code) {
    const fs::path path = folder_ / ("coat" + std::to_string(n) + (forever ? "f" : "o") + std::to_string(code));
    fs::copy_file(folder_ / "begun", path);
    fault = {0, n, forever, code};
    std::set<std::string> allowed = {begun_};
    {
      auto file = DocumentFile::open(path, &room_.context);
      EXPECT_TRUE(file || !text(file.error().what).empty());
      for (const char* line :
           {"sew a=front.side_left b=back.side_left", "drape", "undo", "redo", "move piece=front by=0.1,0,0"}) {
        if (!file) break;
        const std::string before = stateOf(file->document());
        const Result<Step> step = line == std::string("undo")   ? file->undo(room_.context)
                                  : line == std::string("redo") ? file->redo(room_.context)
                                                                : file->perform(*parseOperation(line), room_.context);
        const std::string now = stateOf(file->document());
        if (step) allowed = {now};
        if (step) continue;
        EXPECT_THAT(text(step.error().what), Not(IsEmpty()));
        EXPECT_EQ(now, before) << line;
        if (const auto would = after(*file, line)) allowed.insert(stateOf(*would));
      }
    }
    calls_ = fault.calls;
    fault = {};
    const auto again = DocumentFile::open(path, &room_.context);
    ASSERT_TRUE(again) << text(again.error().what);
    EXPECT_THAT(allowed, Contains(stateOf(again->document())));
    EXPECT_THAT(again->remarks(), IsEmpty());
  }

  fs::path folder_;
  sqlite3_vfs layer_{};
  Workroom room_;
  std::string begun_;
  int calls_ = 0;
};

TEST_F(FailingDisk, WhatWasAcknowledgedIsThereWhicheverCallFails) {
  {
    auto file = DocumentFile::create(folder_ / "begun");
    ASSERT_TRUE(file && room_.play(*file, kTwoPieces));
    begun_ = stateOf(file->document());
  }
  for (const auto& [forever, code] : {std::pair{false, SQLITE_IOERR_WRITE}, {true, SQLITE_FULL}}) {
    int n = 0;
    do {
      SCOPED_TRACE((forever ? "from call " : "at call ") + std::to_string(++n));
      work(n, forever, code);
      if (HasFatalFailure()) return;
    } while (calls_ >= n);
    EXPECT_GT(n, 40) << "the fault was met often";
  }
}

}  // namespace
}  // namespace karinui
