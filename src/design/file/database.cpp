#include "design/file/database.h"

#include <new>
#include <system_error>

namespace karinui {

namespace {

constexpr int kWaitMs = 500;              // for another Karinui that is just closing
constexpr int kLongestValue = 256 << 20;  // bytes of one text or blob

}  // namespace

Error notADocument(const std::filesystem::path& path) {
  return badInput(
      say("“{0}” is not a Karinui document. Patterns, bodies and photographs are imported into one; “karinui play” "
          "reads scripts, “karinui load” dumps.",
          path.filename().string()));
}

Error damagedFile(const std::filesystem::path& path) {
  return damagedDocument(
      say("“{0}” is damaged and cannot be read; nothing was changed. What is whole of it goes to a new document by "
          "“karinui rescue”.",
          path.filename().string()));
}

Result<Database> Database::open(const std::filesystem::path& path, Mode mode) {
  sqlite3* raw = nullptr;
  const int flags = mode == Mode::Create  ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                    : mode == Mode::Write ? SQLITE_OPEN_READWRITE
                                          : SQLITE_OPEN_READONLY;
  Database db(path);  // first: without memory for the path an opened file would never be closed
  const int result = sqlite3_open_v2(path.c_str(), &raw, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  db.raw_.reset(raw);
  if (raw == nullptr) throw std::bad_alloc();
  if (result != SQLITE_OK) return db.error();
  sqlite3_extended_result_codes(raw, 1);
  if (mode == Mode::Write && sqlite3_db_readonly(raw, "main") == 1) {
    return storageError(say("“{0}” may not be written; copy it to a folder of your own, or open it for reading.",
                            path.filename().string()));
  }
  sqlite3_busy_timeout(raw, kWaitMs);
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kLongestValue);
  sqlite3_limit(raw, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  // FULL: a commit is on the disk when it returns. The exclusive lock is the promise that a document has one owner.
  for (const char* pragma : {"PRAGMA cell_size_check=ON", "PRAGMA mmap_size=0", "PRAGMA synchronous=EXTRA"}) {
    if (Done done = db.run(pragma); !done) return done.error();
  }
  // Always a rollback journal, which is safe in a folder on a network too. A new file has one.
  if (mode == Mode::Write) {
    if (Done done = db.keepLock(); !done) return done.error();
    if (Done done = db.run("PRAGMA journal_mode=DELETE"); !done) return done.error();
  }
  return db;
}

Done Database::keepLock() { return run("PRAGMA locking_mode=EXCLUSIVE"); }

Done Database::run(const char* sql) {
  if (sqlite3_exec(raw_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return error();
  return {};
}

void Database::rollBack() noexcept {
  if (sqlite3_get_autocommit(raw_.get()) == 0) sqlite3_exec(raw_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

Result<Database::Statement> Database::ask(const char* sql) const {
  sqlite3_stmt* raw = nullptr;
  if (sqlite3_prepare_v2(raw_.get(), sql, -1, &raw, nullptr) != SQLITE_OK) return error();
  return Statement(*this, raw);
}

Result<std::int64_t> Database::number(const char* sql) {
  auto statement = ask(sql);
  if (!statement) return statement.error();
  const auto row = statement->step();
  if (!row) return row.error();
  return *row ? statement->number(0) : 0;
}

Result<std::string> Database::text(const char* sql) {
  auto statement = ask(sql);
  if (!statement) return statement.error();
  const auto row = statement->step();
  if (!row) return row.error();
  return *row ? statement->text(0) : std::string();
}

bool Database::moved() const {
  int moved = 0;
  sqlite3_file_control(raw_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  return moved != 0;
}

Error Database::movedAway() const {
  return storageError(
      say("“{0}” was moved, renamed or deleted while it is open here; nothing was changed. Put it back, or keep the "
          "garment with File, Save as.",
          path_.filename().string()));
}

Result<std::string> Database::bytes() const {
  struct Free {
    void operator()(unsigned char* bytes) const { sqlite3_free(bytes); }
  };
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, Free> all(sqlite3_serialize(raw_.get(), "main", &size, 0));
  if (all == nullptr) return error();
  return std::string(reinterpret_cast<const char*>(all.get()), static_cast<std::size_t>(size));
}

Error Database::error() const {
  const int code = sqlite3_extended_errcode(raw_.get());
  if (code == SQLITE_NOMEM || code == SQLITE_IOERR_NOMEM) throw std::bad_alloc();
  const std::string name = path_.filename().string();
  if (code == SQLITE_READONLY_DBMOVED) return movedAway();
  switch (code & 0xff) {
    case SQLITE_NOTADB:
      return notADocument(path_);
    case SQLITE_CORRUPT:
    case SQLITE_TOOBIG:
    case SQLITE_MISMATCH:
    case SQLITE_ERROR:
      return damagedFile(path_);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return storageError(say("“{0}” is open in another program; close it there first.", name));
    case SQLITE_FULL:
      return storageError(say("The disk is full; nothing was changed in “{0}”.", name));
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return storageError(
          say("“{0}” may not be written; copy it to a folder of your own, or open it for reading.", name));
    case SQLITE_CANTOPEN:
      return storageError(say("“{0}” cannot be opened: its folder is missing or may not be written.", name));
    default:
      return storageError(
          say("The disk refused while working on “{0}” ({1}); nothing was changed.", name, sqlite3_errmsg(raw_.get())));
  }
}

Database::Statement& Database::Statement::bind(int at, std::int64_t value) {
  if (const int r = sqlite3_bind_int64(raw_.get(), at, value); r != SQLITE_OK) trouble_ = r;
  return *this;
}
Database::Statement& Database::Statement::bind(int at, std::string_view value) {
  const int r = sqlite3_bind_text64(raw_.get(), at, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  if (r != SQLITE_OK) trouble_ = r;
  return *this;
}
Database::Statement& Database::Statement::bindBytes(int at, std::string_view value) {
  const int r = sqlite3_bind_blob64(raw_.get(), at, value.data(), value.size(), SQLITE_TRANSIENT);
  if (r != SQLITE_OK) trouble_ = r;
  return *this;
}
Result<bool> Database::Statement::step() {
  if (trouble_ == SQLITE_TOOBIG) return storageError(say("One part of this document is too large to be kept."));
  if (trouble_ != SQLITE_OK) return owner_->error();
  const int r = sqlite3_step(raw_.get());
  if (r == SQLITE_ROW) return true;
  if (r == SQLITE_DONE) return false;
  return owner_->error();
}
Done Database::Statement::finish() {
  for (;;) {
    const auto row = step();
    if (!row) return row.error();
    if (!*row) return {};
  }
}
std::int64_t Database::Statement::number(int column) const { return sqlite3_column_int64(raw_.get(), column); }
std::string Database::Statement::text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(raw_.get(), column));
  const int size = sqlite3_column_bytes(raw_.get(), column);
  if (bytes == nullptr && sqlite3_errcode(sqlite3_db_handle(raw_.get())) == SQLITE_NOMEM) throw std::bad_alloc();
  return bytes != nullptr && size > 0 ? std::string(bytes, static_cast<std::size_t>(size)) : std::string();
}

}  // namespace karinui
