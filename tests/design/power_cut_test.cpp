// The power goes out. Everything written to the disk is recorded; the disk is then built as it may be found after a cut
// at any call: what was synced is there, of what was written since any part is there or not, in any order, sector by
// sector. The document opens without a remark, and what was acknowledged is in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "design/file_layer.h"
#include "design/quick_folder.h"
#include "design/workroom.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::IsEmpty;

constexpr std::size_t kSector = 512;

struct DiskCall {
  enum class Kind { Make, Write, Truncate, Sync, Delete, SyncedDelete } kind;
  std::string path, bytes;
  std::size_t at = 0;  // of a write; the size after a truncation
};

class RecordingLayer : public FileLayer {
 public:
  std::vector<DiskCall> calls;

 private:
  int keep(DiskCall call) { return calls.push_back(std::move(call)), SQLITE_OK; }
  int onCreate(std::string_view path, bool isNew) override {
    return isNew ? keep({DiskCall::Kind::Make, std::string(path), {}}) : SQLITE_OK;
  }
  int onWrite(std::string_view path, std::string_view bytes, sqlite3_int64 at, int&) override {
    return keep({DiskCall::Kind::Write, std::string(path), std::string(bytes), static_cast<std::size_t>(at)});
  }
  int onTruncate(std::string_view path, sqlite3_int64 size) override {
    return keep({DiskCall::Kind::Truncate, std::string(path), {}, static_cast<std::size_t>(size)});
  }
  int onSync(std::string_view path) override { return keep({DiskCall::Kind::Sync, std::string(path), {}}); }
  int onDelete(std::string_view path, bool sync) override {
    return keep({sync ? DiskCall::Kind::SyncedDelete : DiskCall::Kind::Delete, std::string(path), {}});
  }
};

// What a disk may do with what it was not yet told to keep.
enum class Unsynced { Lost, Kept, SomeInOrder, SomeInAnyOrder, SomeSectors };

// A disk that loses power after so many calls.
class CutDisk {
 public:
  CutDisk(const std::vector<DiskCall>& calls, std::size_t after, Unsynced unsynced, std::uint64_t seed) : dice_(seed) {
    std::vector<DiskCall> pending;
    for (std::size_t k = 0; k < after; ++k) {
      const DiskCall& call = calls[k];
      if (call.kind == DiskCall::Kind::Sync || call.kind == DiskCall::Kind::SyncedDelete) {
        // SQLite syncs the folder with a new journal and with a deletion: names of files are kept then, bytes of the
        // file that is synced.
        std::erase_if(pending, [&](const DiskCall& p) {
          const bool name = p.kind == DiskCall::Kind::Make || p.kind == DiskCall::Kind::Delete;
          const bool folder = call.kind == DiskCall::Kind::SyncedDelete || call.path.ends_with("-journal");
          const bool kept = name ? folder : p.path == call.path && call.kind == DiskCall::Kind::Sync;
          if (kept) happen(p);
          return kept;
        });
        if (call.kind == DiskCall::Kind::SyncedDelete) files_.erase(call.path);
      } else {
        pending.push_back(call);
      }
    }
    if (unsynced == Unsynced::Lost) return;
    if (unsynced == Unsynced::SomeInAnyOrder) std::shuffle(pending.begin(), pending.end(), dice_);
    for (const DiskCall& call : pending) {
      if (unsynced == Unsynced::SomeSectors && call.kind == DiskCall::Kind::Write)
        happenInPart(call);
      else if (unsynced == Unsynced::Kept || dice_() % 2)
        happen(call);
    }
  }

  void leaveIn(const fs::path& folder) const {
    fs::remove_all(folder);
    fs::create_directory(folder);
    for (const auto& [path, bytes] : files_)
      std::ofstream(folder / fs::path(path).filename(), std::ios::binary) << bytes;
  }

 private:
  void write(const std::string& path, std::size_t at, std::string_view bytes) {
    std::string& file = files_[path];
    // Room that was never written to holds what was on the disk before.
    while (file.size() < at + bytes.size()) file += static_cast<char>(dice_());
    file.replace(at, bytes.size(), bytes);
  }
  void happen(const DiskCall& call) {
    switch (call.kind) {
      case DiskCall::Kind::Make:
        files_.try_emplace(call.path);
        break;
      case DiskCall::Kind::Write:
        write(call.path, call.at, call.bytes);
        break;
      case DiskCall::Kind::Truncate:
        if (const auto file = files_.find(call.path); file != files_.end() && file->second.size() > call.at)
          file->second.resize(call.at);
        break;
      default:
        files_.erase(call.path);
    }
  }
  void happenInPart(const DiskCall& call) {
    for (std::size_t from = 0; from < call.bytes.size();) {
      const std::size_t to = std::min(call.bytes.size(), from + kSector - (call.at + from) % kSector);
      if (dice_() % 2) write(call.path, call.at + from, std::string_view(call.bytes).substr(from, to - from));
      from = to;
    }
  }

  std::mt19937_64 dice_;
  std::map<std::string, std::string> files_;
};

class PowerCut : public ::testing::Test {
 protected:
  ~PowerCut() override { fs::remove_all(folder_); }

  struct Acknowledged {  // after so many calls
    std::size_t calls;
    std::string state, log;
  };
  static std::string stateOf(const DocumentFile& file) { return hash(file.document()) + drapeHash(file.document()); }

  const fs::path folder_ = quickFolder();
  Workroom room_;
};

TEST_F(PowerCut, WhatWasAcknowledgedIsThereWhereverItIsCut) {
  std::vector<DiskCall> calls;
  std::vector<Acknowledged> told;
  {
    RecordingLayer disk;
    const auto tell = [&](const DocumentFile& file) { told.push_back({disk.calls.size(), stateOf(file), file.log()}); };
    auto file = DocumentFile::create(folder_ / "coat");
    ASSERT_TRUE(file) << text(file.error().what);
    tell(*file);
    std::istringstream lines(std::string(kTwoPieces) +
                             "sew a=front.side_left b=back.side_left\ndrape\nundo\nredo\nundo\n"
                             "move piece=front by=0.1,0,0\ndrape\nset spacing=20mm\n");
    for (std::string line; std::getline(lines, line);) {
      const Result<Step> step = line == "undo"   ? file->undo(room_.context)
                                : line == "redo" ? file->redo(room_.context)
                                                 : file->perform(*parseOperation(line), room_.context);
      ASSERT_TRUE(step) << line << ": " << text(step.error().what);
      tell(*file);
    }
    *file = DocumentFile::inMemory();  // closed
    calls = disk.calls;
  }
  ASSERT_GT(calls.size(), 100u);
  const fs::path found = folder_ / "found";
  std::size_t between = 0;
  for (std::size_t cut = 0; cut <= calls.size(); ++cut) {
    const auto next = std::find_if(told.begin(), told.end(), [&](const Acknowledged& a) { return a.calls > cut; });
    std::set<std::string> allowed;
    if (next != told.end()) allowed.insert(next->state + next->log);
    if (next != told.begin()) allowed.insert(std::prev(next)->state + std::prev(next)->log);
    for (const auto unsynced :
         {Unsynced::Lost, Unsynced::Kept, Unsynced::SomeInOrder, Unsynced::SomeInAnyOrder, Unsynced::SomeSectors})
      for (int time = 0; time < (unsynced <= Unsynced::Kept ? 1 : soak(2)); ++time) {
        SCOPED_TRACE("cut after call " + std::to_string(cut) + " of " + std::to_string(calls.size()) + ", " +
                     std::to_string(static_cast<int>(unsynced)) + ", " + std::to_string(time));
        CutDisk(calls, cut, unsynced, 1000 * cut + static_cast<std::size_t>(time)).leaveIn(found);
        const auto file = DocumentFile::open(found / "coat", &room_.context);
        if (next == told.begin()) {  // not even told to be there
          EXPECT_TRUE(file || !text(file.error().what).empty());
          continue;
        }
        ASSERT_TRUE(file) << text(file.error().what);
        EXPECT_THAT(file->remarks(), IsEmpty());
        ASSERT_THAT(allowed, Contains(stateOf(*file) + file->log()));
        between += stateOf(*file) + file->log() != std::prev(next)->state + std::prev(next)->log;
      }
  }
  EXPECT_GT(between, 0u) << "some cuts came after the last write and before the word";
}

}  // namespace
}  // namespace karinui
