// Nothing that was acknowledged is lost, and nothing that is no document of ours is taken for one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "design/file_layer.h"
#include "design/workroom.h"
#include "karinui/base/version.h"
#include "karinui/design/print_image.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class KeptDocument : public ::testing::Test {
 protected:
  KeptDocument() {
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "coat.karinui";
  }
  ~KeptDocument() override { fs::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& all) const { std::ofstream(path_, std::ios::binary) << all; }
  void sql(const char* text) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &db), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(db, text, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }
  // A document with some steps, closed. Gives its hash.
  std::string makeOne() {
    auto file = DocumentFile::create(path_);
    EXPECT_TRUE(file);
    EXPECT_TRUE(room_.play(
        *file, std::string(kTwoPieces) + "sew a=front.side_left b=back.side_left\ndrape\nset spacing=5mm\n"));
    return hash(file->document());
  }
  std::string opening() const {
    const auto file = DocumentFile::open(path_);
    return file ? "opened" : text(file.error().what);
  }

  fs::path folder_, path_;
  Workroom room_;
};

TEST_F(KeptDocument, KeepsColoursPrintsAndTheirPhotograph) {
  const PrintPixels image{2, 1, {255, 0, 0, 0, 0, 255}};
  std::string photo, kept, plain;
  {
    auto file = DocumentFile::create(path_);
    ASSERT_TRUE(file);
    ASSERT_TRUE(room_.play(*file, std::string(kTwoPieces)));
    plain = hash(file->document());
    photo = *file->blobs().put(packPrint(image));
    Context own{room_.context.workers, room_.context.token, file->blobs(), room_.context.bodies, {}, {}};
    SetLook look;
    look.fabric = "cotton", look.colour = Dye{10, 20, 30};
    ASSERT_TRUE(file->perform(look, own));
    look = {};
    look.pieces = {PieceRef("front")}, look.photo = photo, look.repeat = Length{0.2};
    const auto step = file->perform(look, own);
    ASSERT_TRUE(step) << text(step.error().what);
    kept = hash(file->document());
    EXPECT_NE(kept, plain);
  }
  auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_EQ(hash(file->document()), kept);
  const Document& document = file->document();
  EXPECT_EQ(lookOf(document, "cotton").colour, (Dye{10, 20, 30}));
  const Look front = lookOf(document, *document.pieceNamed("front"));
  EXPECT_EQ(front.print, PrintKind::Photo);
  EXPECT_EQ(front.repeat, 0.2);
  const auto bytes = file->blobs().get(front.photo);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(unpackPrint(*bytes)->rgb, image.rgb);
  for (std::string damaged : {bytes->substr(0, bytes->size() - 1), *bytes + "x", std::string("karinui")})
    EXPECT_FALSE(unpackPrint(damaged));
}

TEST_F(KeptDocument, IsTheSameAfterClosingAndLeavesOneFile) {
  const std::string before = makeOne();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), before);
  EXPECT_EQ(file->steps().size(), 5u);
  ASSERT_TRUE(file->document().drape.last);
  EXPECT_TRUE(file->document().drape.last->settled);
  EXPECT_EQ(drapeHash(file->document()), file->steps().back().stand);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(KeptDocument, SaysWhichKarinuiMadeIt) {
  { auto file = DocumentFile::create(path_); }
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &db), SQLITE_OK);
  std::string made;
  const auto take = [](void* to, int, char** values, char**) { return *static_cast<std::string*>(to) = values[0], 0; };
  EXPECT_EQ(sqlite3_exec(db, "SELECT value FROM meta WHERE key = 'made by'", take, &made, nullptr), SQLITE_OK);
  sqlite3_close(db);
  EXPECT_EQ(made, "Karinui " + std::string(version()));
}

TEST_F(KeptDocument, IsOpenedWithoutDrapingAgain) {
  makeOne();
  Context never = room_.context;
  never.drape = [](const Document&, const DrapePieces&, Context&) -> Result<DrapeOutcome> {
    return refused(say("draped again"));
  };
  EXPECT_TRUE(DocumentFile::open(path_, &never));
  sql("DELETE FROM snap");  // the kept documents are gone: now they are made again
  const auto again = DocumentFile::open(path_, &never);
  ASSERT_FALSE(again);
  EXPECT_THAT(text(again.error().what), HasSubstr("draped again"));
  EXPECT_TRUE(DocumentFile::open(path_, &room_.context));
}

// A line has no controls, whatever was done to it: with some left in it the kept garment would never match its hash.
TEST_F(KeptDocument, ADartInAStraightEdgeIsOpenedWithoutBeingMadeAgain) {
  {
    auto file = DocumentFile::create(path_);
    ASSERT_TRUE(room_.play(*file, std::string(kTwoPieces) + "dart edge=front.hem at=0.3 width=3cm tip=12cm,20cm\n"));
  }
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->remarks().empty());
}

TEST_F(KeptDocument, UndoAndRedoSurviveClosing) {
  const std::string last = makeOne();
  std::string third;
  {
    auto file = *DocumentFile::open(path_);
    ASSERT_TRUE(file.undo(room_.context));
    ASSERT_TRUE(file.undo(room_.context));
    third = hash(file.document());
    EXPECT_EQ(file.undone().size(), 2u);
  }
  {
    auto file = *DocumentFile::open(path_);
    EXPECT_EQ(hash(file.document()), third);
    ASSERT_TRUE(file.redo(room_.context));
    ASSERT_TRUE(file.redo(room_.context));
    EXPECT_EQ(hash(file.document()), last);
    const auto more = file.redo(room_.context);
    ASSERT_FALSE(more);
    EXPECT_EQ(text(more.error().what), "There is nothing to redo.");
    while (file.undo(room_.context)) {
    }
    EXPECT_EQ(hash(file.document()), hash(Document()));
  }
  auto file = *DocumentFile::open(path_);
  EXPECT_EQ(file.document().operations, 0u);
  // New work after undo: redo is gone from view, the old branch stays in the file.
  ASSERT_TRUE(file.perform(*parseOperation("set ease=1cm"), room_.context));
  EXPECT_TRUE(file.undone().empty());
  EXPECT_EQ(file.steps().front().seq, 6u);
  EXPECT_EQ(file.steps().front().serial, 1u);
}

TEST_F(KeptDocument, KeepsTheImportedBody) {
  const std::string name = *room_.blobs.put(packBody(egg()));
  {
    auto file = *DocumentFile::create(path_);
    ASSERT_TRUE(file.perform(SetBody{{}, {}, {}, false, name}, room_.context));
  }
  Workroom other;  // knows nothing of the body
  auto file = *DocumentFile::open(path_);
  Context own{other.workers, other.token, file.blobs(), other.bodies, {}, {}};
  const auto body = bodyOf(file.document(), own);
  ASSERT_TRUE(body) << text(body.error().what);
  EXPECT_EQ((*body)->hash(), file.document().body.hash);
  EXPECT_EQ((*body)->name(), "egg");
}

TEST_F(KeptDocument, RefusesWhatIsNotOurs) {
  EXPECT_THAT(opening(), HasSubstr("There is no file"));
  write("");
  EXPECT_THAT(opening(), HasSubstr("is empty"));
  write("hello, this is a letter and not a garment");
  EXPECT_THAT(opening(), HasSubstr("is not a Karinui document"));
  fs::remove(path_);
  sql("CREATE TABLE birds(name TEXT)");
  EXPECT_THAT(opening(), HasSubstr("is not a Karinui document"));
  fs::remove(path_);
  makeOne();
  EXPECT_THAT(text(DocumentFile::create(path_).error().what), HasSubstr("There is already a file"));
  EXPECT_EQ(opening(), "opened");
  sql("PRAGMA user_version=7");
  EXPECT_THAT(opening(), HasSubstr("made by a newer Karinui (form 7)"));
  sql("PRAGMA user_version=1; CREATE TRIGGER t AFTER INSERT ON op BEGIN DELETE FROM op; END");
  EXPECT_THAT(opening(), HasSubstr("holds something a Karinui document does not have (“t”)"));
  sql("DROP TRIGGER t; UPDATE op SET args = 'ease=2mm' WHERE seq = 5");
  EXPECT_THAT(opening(), HasSubstr("damaged"));
  EXPECT_THAT(text(DocumentFile::create(folder_ / "nowhere" / "x.karinui").error().what),
              HasSubstr("folder is missing"));
  EXPECT_THAT(text(DocumentFile::open(folder_).error().what), HasSubstr("is not a file"));
}

TEST_F(KeptDocument, HasOneOwnerAtATime) {
  makeOne();
  const auto first = DocumentFile::open(path_);
  ASSERT_TRUE(first);
  EXPECT_THAT(opening(), HasSubstr("is open in another program"));
}

// Another process, as locks within one are SQLite's own.
TEST_F(KeptDocument, IsLeftAloneWhileAnotherProgramHasItAndFreeAfterThatWasKilled) {
  const std::string before = makeOne();
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t other = ::fork();
  if (other == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // where the test itself is ended
    const auto file = DocumentFile::open(path_);
    const char opened = file ? 'y' : 'n';
    if (::write(ends[1], &opened, 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char opened = 0;
  ASSERT_EQ(::read(ends[0], &opened, 1), 1);
  EXPECT_EQ(opened, 'y');
  const std::string all = bytes();
  EXPECT_THAT(opening(), HasSubstr("is open in another program; close it there first"));
  const auto reading = DocumentFile::openForReading(path_);
  EXPECT_THAT(reading ? "it was opened" : text(reading.error().what), HasSubstr("is open in another program"));
  EXPECT_THAT(text(DocumentFile::create(path_).error().what), HasSubstr("There is already a file"));
  EXPECT_EQ(bytes(), all);
  ::kill(other, SIGKILL);
  int status = 0;
  ::waitpid(other, &status, 0);
  ::close(ends[0]), ::close(ends[1]);
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), before);
}

TEST_F(KeptDocument, OfTwoProgramsThatMakeOneNameAtOnceOneDoes) {
  for (int run = 0; run < soak(30); ++run) {
    fs::remove(path_);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    pid_t children[2];
    for (pid_t& child : children) {
      child = ::fork();
      if (child != 0) continue;
      ::close(ends[1]);
      char none;
      (void)!::read(ends[0], &none, 1);  // until both are there
      auto file = DocumentFile::create(path_);
      const bool done = file && file->perform(*parseOperation("set spacing=20mm"), room_.context);
      ::_exit(done ? 0 : 1);
    }
    ::close(ends[0]), ::close(ends[1]);
    int made = 0;
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      ASSERT_TRUE(WIFEXITED(status));
      made += WEXITSTATUS(status) == 0;
    }
    EXPECT_EQ(made, 1) << "run " << run;
    const auto file = DocumentFile::open(path_);
    ASSERT_TRUE(file) << "run " << run << ": " << text(file.error().what);
    EXPECT_EQ(file->steps().size(), 1u);
  }
}

TEST_F(KeptDocument, IsNobodyElsesFromTheFirstMoment) {
  struct Watch : FileLayer {
    std::vector<fs::perms> seen;
    int look(std::string_view path) {
      seen.push_back(fs::status(path).permissions());
      return SQLITE_OK;
    }
    int onWrite(std::string_view path, std::string_view, sqlite3_int64, int&) override { return look(path); }
    int onTruncate(std::string_view path, sqlite3_int64) override { return look(path); }
    int onSync(std::string_view path) override { return look(path); }
    int onDelete(std::string_view path, bool) override { return look(path); }
  } watch;
  makeOne();
  EXPECT_GT(watch.seen.size(), 20u);
  EXPECT_THAT(watch.seen, ::testing::Each(fs::perms::owner_read | fs::perms::owner_write));
}

// A folder on a network: rollback journals, as everywhere, for a log that is written ahead needs memory that programs
// share, which there is not between machines. Where the folder has no locks, nobody could tell whether the document is
// open on another machine, so it is not opened.
TEST_F(KeptDocument, IsSafeOnANetworkAndRefusedWhereNothingCanBeLocked) {
  struct Network : FileLayer {
    std::set<std::string> endings;
    bool locks = true;
    int see(std::string_view path) {
      const std::string name = fs::path(path).filename().string();
      if (!name.empty()) endings.insert(name);
      return SQLITE_OK;
    }
    int onCreate(std::string_view path, bool) override { return see(path); }
    int onWrite(std::string_view path, std::string_view, sqlite3_int64, int&) override { return see(path); }
    int onTruncate(std::string_view path, sqlite3_int64) override { return see(path); }
    int onSync(std::string_view path) override { return see(path); }
    int onDelete(std::string_view path, bool) override { return see(path); }
    int onLock(std::string_view, int) override { return locks ? SQLITE_OK : SQLITE_IOERR_LOCK; }
  } network;
  const std::string before = makeOne();
  EXPECT_THAT(network.endings, ::testing::ElementsAre("coat.karinui", "coat.karinui-journal"));
  const std::string all = bytes();
  network.locks = false;
  EXPECT_THAT(opening(), HasSubstr("The disk refused while working on “coat.karinui”"));
  EXPECT_THAT(text(DocumentFile::openForReading(path_).error().what), HasSubstr("The disk refused"));
  EXPECT_THAT(text(DocumentFile::create(folder_ / "new.karinui").error().what), HasSubstr("The disk refused"));
  EXPECT_EQ(bytes(), all);
  network.locks = true;
  EXPECT_TRUE(DocumentFile::create(folder_ / "new.karinui"));
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), before);
}

// Another program may have switched it to a log written ahead: that is taken back when it is opened for work.
TEST_F(KeptDocument, AFileSwitchedToAnotherJournalIsSwitchedBack) {
  const std::string before = makeOne();
  sql("PRAGMA journal_mode=WAL");
  EXPECT_EQ(bytes().substr(18, 2), "\2\2");
  {
    const auto read = DocumentFile::openForReading(path_);
    ASSERT_TRUE(read) << text(read.error().what);
    EXPECT_EQ(hash(read->document()), before);
  }
  {
    auto file = DocumentFile::open(path_);
    ASSERT_TRUE(file) << text(file.error().what);
    EXPECT_EQ(hash(file->document()), before);
    EXPECT_TRUE(file->perform(*parseOperation("set spacing=20mm"), room_.context));
    EXPECT_FALSE(fs::exists(path_.string() + "-wal"));
  }
  EXPECT_EQ(bytes().substr(18, 2), "\1\1");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(KeptDocument, MayBeReadWhereItMayNotBeWritten) {
  const std::string before = makeOne();
  auto file = DocumentFile::openForReading(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), before);
  const auto step = file->perform(*parseOperation("set ease=1cm"), room_.context);
  ASSERT_FALSE(step);
  EXPECT_THAT(text(step.error().what), HasSubstr("opened for reading only"));
  EXPECT_FALSE(file->undo(room_.context));
}

// In a child, because the limit on file sizes is the process's own.
TEST_F(KeptDocument, StaysWholeWhenTheDiskIsFull) {
  const std::string before = makeOne();
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    auto file = DocumentFile::open(path_);
    const rlimit limit{fs::file_size(path_) + 8192, RLIM_INFINITY};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int refusals = 0;
    for (int i = 0; file && i < 60; ++i) {
      if (!file->perform(*parseOperation("piece name=x" + std::to_string(i) +
                                         " outline=\"M 0 0; a L 100 0; b L 100 100; c L 0 0\""),
                         room_.context)) {
        ++refusals;
      }
    }
    const bool consistent = file && file->steps().size() == 5 + 60u - static_cast<std::size_t>(refusals);
    ::_exit(refusals > 0 && consistent ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  while (file->steps().size() > 5) ASSERT_TRUE(file->undo(room_.context));
  EXPECT_EQ(hash(file->document()), before);
}

// A child works and says over a pipe what it was told is kept; it is killed at any moment. What is found then is what a
// run that was not killed had at that step, and leads to the same.
TEST_F(KeptDocument, LosesNothingWhenTheProgramIsKilled) {
  std::mt19937_64 dice(20261121);
  const auto work = [&](DocumentFile& file, std::uint64_t i) {
    return i % 5 == 4   ? file.undo(room_.context)
           : i % 5 == 3 ? file.perform(*parseOperation("drape"), room_.context)
                        : file.perform(*parseOperation("move piece=front by=0,1mm,0"), room_.context);
  };
  const auto stateOf = [](const DocumentFile& file) {
    return hash(file.document()) + drapeHash(file.document()) + file.log();
  };
  auto whole = DocumentFile::inMemory();
  ASSERT_TRUE(room_.play(whole, kTwoPieces));
  std::vector<std::string> states;  // of the run that was not killed
  const auto stateAfter = [&](std::uint64_t i) {
    while (states.size() <= i) {
      EXPECT_TRUE(work(whole, states.size()));
      states.push_back(stateOf(whole));
    }
    return states[i];
  };
  for (int run = 0; run < soak(200); ++run) {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      auto file = DocumentFile::create(path_);
      if (!file || !room_.play(*file, kTwoPieces)) ::_exit(1);
      for (std::uint32_t i = 0;; ++i) {
        if (!work(*file, i)) ::_exit(2);
        const std::uint64_t said[2] = {i, file->steps().back().seq};
        if (::write(ends[1], said, sizeof said) != sizeof said) ::_exit(3);
      }
    }
    ::close(ends[1]);
    std::uint64_t said[2] = {0, 0}, last[2] = {0, 0};
    bool any = false;
    for (std::uint64_t n = 0, until = dice() % 12; n <= until && ::read(ends[0], said, sizeof said) == sizeof said;
         ++n) {
      std::copy_n(said, 2, last), any = true;
    }
    volatile std::uint64_t idle = 0;  // some moment within the next transaction
    for (std::uint64_t n = dice() % 2'000'000; n > 0; --n) idle = idle + n;
    ::kill(child, SIGKILL);
    while (::read(ends[0], said, sizeof said) == sizeof said) std::copy_n(said, 2, last);  // said before it died
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && any) << "run " << run;

    auto file = DocumentFile::open(path_);
    ASSERT_TRUE(file) << "run " << run << ": " << text(file.error().what);
    ASSERT_EQ(hash(file->document()), file->steps().back().after);
    // What the child had said is there; at most the one thing it was just doing came after.
    const auto steps = file->steps();
    const bool asSaid = steps.back().seq == last[1];
    const bool oneMore = steps.back().seq > last[1] || (last[0] + 1) % 5 == 4;
    ASSERT_TRUE(asSaid || oneMore) << "run " << run << ": said " << last[1] << ", found " << steps.back().seq;
    std::uint64_t done = last[0];
    if (stateOf(*file) != stateAfter(done)) ++done;
    ASSERT_EQ(stateOf(*file), stateAfter(done)) << "run " << run;
    while (++done < last[0] + 7) ASSERT_TRUE(work(*file, done)) << "run " << run;
    ASSERT_EQ(stateOf(*file), stateAfter(done - 1)) << "run " << run;
  }
}

// Two hundred damaged copies: each is refused in a sentence, or opens with what it had.
TEST_F(KeptDocument, DamagedFilesAreRefusedOrWhole) {
  makeOne();
  const std::string good = bytes();
  auto whole = *DocumentFile::open(path_);
  const std::string log = whole.log();
  std::map<std::string, std::string> known;  // chain -> document
  for (const Step& s : whole.steps()) known[s.chain] = s.after;
  whole = DocumentFile::inMemory();
  std::mt19937_64 dice(4711);
  int opened = 0;
  for (int seed = 0; seed < soak(200); ++seed) {
    std::string bad = good;
    if (seed % 4 == 0) bad.resize(dice() % bad.size());
    for (std::size_t i = 0, n = seed % 4 == 1 ? 1 : 1 + dice() % 30; i < n && !bad.empty(); ++i)
      bad[dice() % bad.size()] ^= static_cast<char>(1 + dice() % 255);
    write(bad);
    const auto file = DocumentFile::open(path_, &room_.context);
    if (!file) {
      EXPECT_FALSE(text(file.error().what).empty());
      continue;
    }
    ++opened;
    EXPECT_EQ(file->log(), log) << seed;
    EXPECT_EQ(hash(file->document()), known.at(file->steps().back().chain)) << seed;
  }
  EXPECT_GT(opened, 0);
  EXPECT_LT(opened, soak(200));
}

}  // namespace
}  // namespace karinui
