// The n-th call to the disk fails, for n = 1, 2, 3 … until all went well: the file opens, and what was acknowledged is
// there. Of steps that were refused since only the disk knows: one is there whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "design/file_layer.h"
#include "design/quick_folder.h"
#include "design/workroom.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

class FailingLayer : public FileLayer {
 public:
  int calls = 0;         // that open, read or change a file
  int failing = 0;       // the one that fails; 0: none
  bool forever = false;  // and all that follow
  int code = SQLITE_IOERR_WRITE;

 private:
  int failed(int as) {
    ++calls;
    return failing > 0 && (forever ? calls >= failing : calls == failing) ? as : SQLITE_OK;
  }
  int onCreate(std::string_view, bool) override { return failed(SQLITE_CANTOPEN); }
  int onOpen(std::string_view) override { return failed(SQLITE_CANTOPEN); }
  int onRead(std::string_view) override { return failed(SQLITE_IOERR_READ); }
  int onSize(std::string_view) override { return failed(SQLITE_IOERR_FSTAT); }
  int onWrite(std::string_view, std::string_view bytes, sqlite3_int64, int& taken) override {
    taken = static_cast<int>(bytes.size() / 1024 * 512);  // some of its sectors come to the disk
    return failed(code);
  }
  int onTruncate(std::string_view, sqlite3_int64) override { return failed(code); }
  int onSync(std::string_view) override { return failed(SQLITE_IOERR_FSYNC); }
  int onDelete(std::string_view, bool) override { return failed(SQLITE_IOERR_DELETE); }
  int characteristics(int) const override { return 0; }
};

class FailingDisk : public ::testing::Test {
 protected:
  ~FailingDisk() override { fs::remove_all(folder_); }

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
    layer_.calls = 0, layer_.failing = n, layer_.forever = forever, layer_.code = code;
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
    calls_ = layer_.calls;
    layer_.failing = 0;
    const auto again = DocumentFile::open(path, &room_.context);
    ASSERT_TRUE(again) << text(again.error().what);
    EXPECT_THAT(allowed, Contains(stateOf(again->document())));
    EXPECT_THAT(again->remarks(), IsEmpty());
  }

  const fs::path folder_ = quickFolder();
  FailingLayer layer_;
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
    EXPECT_GT(n, 60) << "the fault was met often";
  }
}

}  // namespace
}  // namespace karinui
