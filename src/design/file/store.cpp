#include "design/file/store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "karinui/base/hash.h"
#include "karinui/base/version.h"
#include "karinui/design/apply.h"
#include "karinui/design/history.h"

namespace karinui {

namespace {

constexpr std::int64_t kApplication = 0x4b524e55;  // "KRNU"
constexpr std::int64_t kVersion = 1;
constexpr std::size_t kMostSteps = 1'000'000;

constexpr std::array<std::pair<std::string_view, const char*>, 5> kTables{{
    {"meta", "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID"},
    {"op",
     "CREATE TABLE op(seq INTEGER PRIMARY KEY, parent INTEGER NOT NULL, serial INTEGER NOT NULL, kind TEXT NOT NULL, "
     "args TEXT NOT NULL, chain TEXT NOT NULL, pre_hash TEXT NOT NULL, post_hash TEXT NOT NULL, stand_hash TEXT NOT "
     "NULL, "
     "seal TEXT NOT NULL)"},
    {"blob", "CREATE TABLE blob(hash TEXT PRIMARY KEY, bytes BLOB NOT NULL)"},
    {"snap",
     "CREATE TABLE snap(seq INTEGER NOT NULL, part TEXT NOT NULL, blob TEXT NOT NULL, PRIMARY KEY(seq, part)) WITHOUT "
     "ROWID"},
    {"head",
     "CREATE TABLE head(branch INTEGER PRIMARY KEY, seq INTEGER NOT NULL, tip INTEGER NOT NULL, seal TEXT NOT NULL)"},
}};

std::string sealOf(Head head) { return Hasher().add(std::string_view("head")).add(head.seq).add(head.tip).hex(); }

// Looks at the file before SQLite does: the commonest mistakes deserve plain words.
Done lookAt(const std::filesystem::path& path) {
  std::error_code trouble;
  const auto status = std::filesystem::status(path, trouble);
  const std::string name = path.filename().string();
  if (status.type() == std::filesystem::file_type::not_found)
    return notFound(say("There is no file “{0}”.", path.string()));
  if (!std::filesystem::is_regular_file(status))
    return badInput(say("“{0}” is not a file; name a document.", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::array<char, 16> first{};
  file.read(first.data(), first.size());
  if (file.gcount() == 0 && !file.is_open())
    return storageError(say("“{0}” may not be read; ask whose it is for leave, or for a copy.", name));
  if (file.gcount() == 0) return badInput(say("“{0}” is empty; take an older copy of it.", name));
  if (std::string_view(first.data(), first.size()) != std::string_view("SQLite format 3\0", 16))
    return notADocument(path);
  return {};
}

Done checkForm(Database& db, bool damagedToo) {
  const std::string name = db.path().filename().string();
  const auto application = db.number("PRAGMA application_id");
  if (!application) return application.error();
  if (*application != kApplication) return notADocument(db.path());
  const auto version = db.number("PRAGMA user_version");
  if (!version) return version.error();
  if (*version > kVersion) {
    return badInput(
        say("“{0}” was made by a newer Karinui (form {1}); this one reads up to form {2}. Install the newer one.", name,
            static_cast<long long>(*version), static_cast<long long>(kVersion)));
  }
  if (*version < 1) return damagedFile(db.path());
  if (!damagedToo) {
    const auto sound = db.text("PRAGMA quick_check(1)");
    if (!sound) return sound.error();
    if (*sound != "ok") return damagedFile(db.path());
  }
  // Exactly our tables: nothing that could run, nothing that could redirect.
  auto schema = db.ask("SELECT name, sql FROM sqlite_master WHERE name NOT LIKE 'sqlite_autoindex_%' ORDER BY name");
  if (!schema) return schema.error();
  std::size_t found = 0;
  for (;;) {
    const auto row = schema->step();
    if (!row) return row.error();
    if (!*row) break;
    bool ours = false;
    for (const auto& [table, sql] : kTables) ours = ours || (schema->text(0) == table && schema->text(1) == sql);
    if (!ours)
      return badInput(
          say("“{0}” holds something a Karinui document does not have (“{1}”): another program wrote into it. Take an "
              "older copy of it.",
              name, schema->text(0)));
    ++found;
  }
  return found == kTables.size() ? Done() : Done(damagedFile(db.path()));
}

}  // namespace

void dropJournal(const std::filesystem::path& path) {
  std::error_code none;
  std::filesystem::remove(path.string() + "-journal", none);
}

std::string StepRow::seal() const {
  Hasher h;
  h.add(seq).add(parent).add(std::uint64_t{serial});
  for (const auto& text : {kind, args, chain, before, after, stand}) h.add(std::string_view(text));
  return h.hex();
}

Result<Store> Store::create(const std::filesystem::path& path) {
  std::error_code trouble;
  const Error taken = storageError(say("There is already a file “{0}”; choose another name.", path.string()));
  // Measurements are personal: nobody else may read the file, from its first moment.
  const int made = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (made >= 0) {
    ::close(made);
    dropJournal(path);
  } else if (errno == EEXIST && std::filesystem::file_size(path, trouble) != 0) {
    return taken;
  }
  auto db = Database::open(path, Database::Mode::Create);
  Done done = db ? db->run("BEGIN IMMEDIATE") : Done(db.error());
  // Of two programs that make a file of this name at the same time one gets the lock; the other leaves it alone. The
  // lock is kept from now on and not before: one that waits for it may hold none that the first one's commit waits for.
  if (done) done = db->keepLock();
  if (!done) return done.error();
  const auto tables = db->number("SELECT count(*) FROM sqlite_master");
  if (tables && *tables != 0) return taken;
  std::string sql = "PRAGMA application_id=" + std::to_string(kApplication) +
                    "; PRAGMA user_version=" + std::to_string(kVersion) + ";";
  for (const auto& [name, table] : kTables) sql += std::string(table) + ";";
  sql += "INSERT INTO meta VALUES('made by', 'Karinui " + std::string(version()) +
         "'); INSERT INTO head VALUES(1, 0, 0, '" + sealOf({}) + "'); COMMIT;";
  if (done = db->run(sql.c_str()); !done) {
    db = done.error();  // closes it, so that what was begun can go
    std::filesystem::remove(path, trouble);
    return done.error();
  }
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write, trouble);
  Store store(*std::move(db));
  store.writable_ = true;
  return store;
}

Result<Store> Store::open(const std::filesystem::path& path, bool toWrite) {
  if (Done done = lookAt(path); !done) return done.error();
  auto db = Database::open(path, toWrite ? Database::Mode::Write : Database::Mode::Read);
  if (!db) return db.error();
  if (toWrite) {
    // Takes the lock now, and finds out now whether the file can be written.
    if (Done done = db->run("BEGIN EXCLUSIVE; COMMIT;"); !done) return done.error();
  }
  if (Done done = checkForm(*db, false); !done) return done.error();
  Store store(*std::move(db));
  store.writable_ = toWrite;
  if (Done done = store.load(false); !done) return done.error();
  return store;
}

Result<Store> Store::openDamaged(const std::filesystem::path& path) {
  if (Done done = lookAt(path); !done) return done.error();
  auto db = Database::open(path, Database::Mode::Read);
  if (!db) return db.error();
  if (Done done = checkForm(*db, true); !done) return done.error();
  Store store(*std::move(db));
  if (Done done = store.load(true); !done) return done.error();
  return store;
}

Done Store::load(bool damagedToo) {
  auto rows = db_.ask(
      "SELECT seq, parent, serial, kind, args, chain, pre_hash, post_hash, stand_hash, seal FROM op ORDER BY seq");
  if (!rows) return rows.error();
  std::map<std::uint64_t, std::uint32_t> serials{{0, 0}};
  for (;;) {
    const auto more = rows->step();
    if (!more && damagedToo && !rows_.empty()) {  // a page of the table is lost, and all rows behind it
      ++unsound_;
      break;
    }
    if (!more) return more.error();
    if (!*more) break;
    StepRow row;
    row.seq = static_cast<std::uint64_t>(rows->number(0));
    row.parent = static_cast<std::uint64_t>(rows->number(1));
    row.serial = static_cast<std::uint32_t>(rows->number(2));
    row.kind = rows->text(3), row.args = rows->text(4), row.chain = rows->text(5);
    row.before = rows->text(6), row.after = rows->text(7), row.stand = rows->text(8);
    const auto parent = serials.find(row.parent);
    const bool sound = row.seq > 0 && row.parent < row.seq && parent != serials.end() &&
                       row.serial == parent->second + 1 && row.seal() == rows->text(9) && rows_.size() < kMostSteps;
    if (!sound && damagedToo) {
      ++unsound_;
      continue;
    }
    if (!sound) return damagedFile(db_.path());
    serials[row.seq] = row.serial;
    rows_.push_back(std::move(row));
  }
  auto head = db_.ask("SELECT seq, tip, seal FROM head WHERE branch = 1");
  if (!head) return head.error();
  const auto there = head->step();
  if (!damagedToo && !there) return there.error();
  if (!damagedToo && !*there) return damagedFile(db_.path());
  if (there && *there)
    head_ = {static_cast<std::uint64_t>(head->number(0)), static_cast<std::uint64_t>(head->number(1))};
  if (serials.contains(head_.seq) && serials.contains(head_.tip) && head->text(2) == sealOf(head_)) return {};
  if (!damagedToo) return damagedFile(db_.path());
  head_.seq = head_.tip = rows_.empty() ? 0 : rows_.back().seq;
  return {};
}

Done Store::insertBlob(const std::string& name, std::string_view bytes) {
  auto insert = db_.ask("INSERT INTO blob VALUES(?1, ?2) ON CONFLICT(hash) DO UPDATE SET bytes = ?2 WHERE bytes <> ?2");
  if (!insert) return insert.error();
  return insert->bind(1, name).bindBytes(2, bytes).finish();
}

Done Store::insertRow(const StepRow& row, const Parts& parts) {
  auto insert = db_.ask("INSERT INTO op VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return insert.error();
  insert->bind(1, static_cast<std::int64_t>(row.seq)).bind(2, static_cast<std::int64_t>(row.parent));
  insert->bind(3, std::int64_t{row.serial}).bind(4, row.kind).bind(5, row.args).bind(6, row.chain);
  insert->bind(7, row.before).bind(8, row.after).bind(9, row.stand).bind(10, row.seal());
  if (Done done = insert->finish(); !done) return done;
  for (const auto& [part, blob] : parts) {
    auto kept = db_.ask("INSERT INTO snap VALUES(?, ?, ?)");
    if (!kept) return kept.error();
    if (Done done = kept->bind(1, static_cast<std::int64_t>(row.seq)).bind(2, part).bind(3, blob).finish(); !done)
      return done;
  }
  return {};
}

Done Store::updateHead(Head head) {
  auto update = db_.ask("UPDATE head SET seq = ?, tip = ?, seal = ? WHERE branch = 1");
  if (!update) return update.error();
  update->bind(1, static_cast<std::int64_t>(head.seq))
      .bind(2, static_cast<std::int64_t>(head.tip))
      .bind(3, sealOf(head));
  return update->finish();
}

Done Store::inOneTransaction(const std::function<Done()>& work) {
  db_.rollBack();                           // what could not be for want of memory
  if (db_.moved()) return db_.movedAway();  // SQLite asks only before the first step
  if (Done done = db_.run("BEGIN IMMEDIATE"); !done) return done;
  try {
    Done done = work();
    if (done) done = db_.run("COMMIT");
    if (!done) db_.rollBack();
    return done;
  } catch (...) {  // no memory for what is to be written
    db_.rollBack();
    throw;
  }
}

Done Store::fill(const Content& content) {
  const Done done = inOneTransaction([&]() -> Done {
    for (const auto& [name, bytes] : content.blobs)
      if (Done kept = insertBlob(name, bytes); !kept) return kept;
    for (const auto& [row, parts] : content.steps)
      if (Done kept = insertRow(row, parts); !kept) return kept;
    return updateHead(content.head);
  });
  if (!done) return done;
  head_ = content.head;
  return {};
}

Done Store::move(Head head) {
  const Done done = inOneTransaction([&] { return updateHead(head); });
  if (done) head_ = head;
  return done;
}

Done Store::keep(const std::string& name, std::string_view bytes) {
  return inOneTransaction([&] { return insertBlob(name, bytes); });
}

bool isPart(std::string_view name) {
  const auto counted = [](std::string_view word) {
    return !word.empty() && word.size() <= 20 && word.find_first_not_of("0123456789") == std::string_view::npos &&
           (word.size() == 1 || word[0] != '0');
  };
  for (const std::string_view kind : {"piece ", "form "})
    if (name.starts_with(kind)) return counted(name.substr(kind.size()));
  if (constexpr std::string_view kRested = "rested "; name.starts_with(kRested)) {
    const std::string_view which = name.substr(kRested.size());
    const std::size_t dot = which.find('.');
    return dot != std::string_view::npos && counted(which.substr(0, dot)) && counted(which.substr(dot + 1));
  }
  return name == "rest" || name == "figure";
}

Result<Parts> Store::parts(std::uint64_t seq) const {
  auto rows = db_.ask("SELECT part, blob FROM snap WHERE seq = ?");
  if (!rows) return rows.error();
  rows->bind(1, static_cast<std::int64_t>(seq));
  Parts all;
  for (;;) {
    const auto more = rows->step();
    if (!more) return more.error();
    if (!*more) return all;
    all[rows->text(0)] = rows->text(1);
  }
}

std::vector<std::uint64_t> Store::keptSteps() const {
  std::vector<std::uint64_t> all;
  auto rows = db_.ask("SELECT DISTINCT seq FROM snap ORDER BY seq DESC");
  for (auto more = rows ? rows->step() : Result<bool>(false); more && *more; more = rows->step())
    all.push_back(static_cast<std::uint64_t>(rows->number(0)));
  return all;
}

Result<std::string> Store::blob(const std::string& name) const {
  auto rows = db_.ask("SELECT bytes FROM blob WHERE hash = ?");
  if (!rows) return rows.error();
  const auto there = rows->bind(1, name).step();
  if (!there) return there.error();
  if (!*there) return notFound(say("The stored part {0} is not in this document.", name));
  std::string bytes = rows->text(0);
  if (blobName(bytes) != name) return damagedFile(db_.path());
  return bytes;
}

std::vector<std::string> Store::blobNames() const {
  std::vector<std::string> all;
  auto rows = db_.ask("SELECT hash FROM blob");
  for (auto more = rows ? rows->step() : Result<bool>(false); more && *more; more = rows->step())
    all.push_back(rows->text(0));
  return all;
}

}  // namespace karinui
