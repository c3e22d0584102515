#pragma once
// SQLite behind a small face: statements that free themselves, errors as sentences. One thread.
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

class Database {
 public:
  enum class Mode { Create, Write, Read };
  // Opens with everything switched off that a hostile file could use. Takes the lock at once in Write mode.
  static Result<Database> open(const std::filesystem::path& path, Mode mode);

  // Locks that are taken from now on are kept until it is closed.
  Done keepLock();
  Done run(const char* sql);
  void rollBack() noexcept;                      // a transaction under way; nothing where there is none
  Result<std::int64_t> number(const char* sql);  // the first column of the first row
  Result<std::string> text(const char* sql);
  // What SQLite last complained of, as a sentence about this file. Throws std::bad_alloc where it had no memory: that
  // is no damage of the file.
  Error error() const;
  const std::filesystem::path& path() const { return path_; }
  bool moved() const;  // the file was moved, renamed or deleted since it was opened
  Error movedAway() const;
  // The file as it was written, also where it was moved or deleted since.
  Result<std::string> bytes() const;

  // One prepared question. Parameters count from 1, columns from 0.
  class Statement {
   public:
    Statement& bind(int at, std::int64_t value);
    Statement& bind(int at, std::string_view value);
    Statement& bindBytes(int at, std::string_view value);
    Result<bool> step();  // true: there is a row
    Done finish();        // steps to the end
    std::int64_t number(int column) const;
    std::string text(int column) const;  // also of blobs

   private:
    friend class Database;
    struct Free {
      void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
    };
    Statement(const Database& owner, sqlite3_stmt* raw) : owner_(&owner), raw_(raw) {}
    const Database* owner_;
    std::unique_ptr<sqlite3_stmt, Free> raw_;
    int trouble_ = SQLITE_OK;
  };
  Result<Statement> ask(const char* sql) const;

 private:
  struct Close {
    void operator()(sqlite3* db) const { sqlite3_close_v2(db); }
  };
  explicit Database(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> raw_;
};

// What is said of a file that is none of ours, and of one of ours that is not whole.
Error notADocument(const std::filesystem::path& path);
Error damagedFile(const std::filesystem::path& path);

}  // namespace karinui
