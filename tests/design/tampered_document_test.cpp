// A seal is no proof: whoever can write a file can seal it. What was changed is told, and what is whole can be saved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "design/chain.h"
#include "design/file/store.h"
#include "design/pack.h"
#include "design/workroom.h"
#include "karinui/body/sizes.h"
#include "karinui/design/dump.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class TamperedDocument : public ::testing::Test {
 protected:
  TamperedDocument() {
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "coat.karinui";
    auto file = DocumentFile::create(path_);
    EXPECT_TRUE(file && room_.play(*file, std::string(kTwoPieces) +
                                              "sew a=front.side_left b=back.side_left\ndrape\nset spacing=5mm\n"));
    whole_ = file->document();
    steps_ = file->steps();
  }
  ~TamperedDocument() override { fs::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& all) const { std::ofstream(path_, std::ios::binary) << all; }
  void sql(const std::string& text) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &db), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(db, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }
  std::vector<StepRow> rows() const { return Store::open(path_, false)->rows(); }
  void put(const StepRow& row) const {
    sql("UPDATE op SET parent = " + std::to_string(row.parent) + ", serial = " + std::to_string(row.serial) +
        ", chain = '" + row.chain + "', pre_hash = '" + row.before + "', post_hash = '" + row.after +
        "', stand_hash = '" + row.stand + "', seal = '" + row.seal() + "' WHERE seq = " + std::to_string(row.seq));
  }
  void keep(const std::string& part, const std::string& bytes, int seq = 5) const {
    std::string hex;
    for (const unsigned char c : bytes) hex += "0123456789abcdef"[c >> 4], hex += "0123456789abcdef"[c & 15];
    sql("INSERT OR IGNORE INTO blob VALUES('" + blobName(bytes) + "', x'" + hex + "'); UPDATE snap SET blob = '" +
        blobName(bytes) + "' WHERE seq = " + std::to_string(seq) + " AND part = '" + part + "'");
  }
  // The document kept beside the last step is another one, with every hash and seal as it should be.
  void forge(const Document& forged) const {
    keep("rest", packRest(forged));
    for (const auto& [id, piece] : forged.pattern.pieces) {
      keep("piece " + std::to_string(id.value), packPiece(*piece));
      if (piece->form) keep("form " + std::to_string(id.value), packForm(*piece->form));
    }
    StepRow last = rows().back();
    last.after = hash(forged), last.stand = drapeHash(forged);
    put(last);
  }
  std::vector<std::string> remarks(const DocumentFile& file) const {
    std::vector<std::string> all;
    for (const Message& remark : file.remarks()) all.push_back(text(remark));
    return all;
  }

  fs::path folder_, path_;
  Workroom room_;
  Document whole_;
  std::vector<Step> steps_;
};

TEST_F(TamperedDocument, AFileAsItWasWrittenIsReadWithoutAWord) {
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_THAT(remarks(*file), IsEmpty());
}

TEST_F(TamperedDocument, ContentThatNoOperationLeadsToIsMadeAgainFromTheSteps) {
  const PieceId id = whole_.pattern.pieces.begin()->first;
  const auto change = [&](const std::function<void(Piece&)>& edit) {
    return [id, edit](Document& d) {
      Piece piece = *d.find(id);
      edit(piece);
      d.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
    };
  };
  const auto form = [](const std::function<void(Form&)>& edit) {
    return [edit](Piece& p) {
      Form now = *p.form;
      edit(now);
      p.form = std::make_shared<const Form>(std::move(now));
    };
  };
  const std::vector<std::pair<const char*, std::function<void(Document&)>>> forgeries = {
      {"no edges", change([](Piece& p) { p.outline.edges.clear(); })},
      {"an open outline", change([](Piece& p) { p.outline.edges[0].curve.end.u += 0.01; })},
      {"turned round", change([](Piece& p) {
         std::reverse(p.outline.edges.begin(), p.outline.edges.end());
         for (Edge& e : p.outline.edges) e.curve = e.curve.reversed();
       })},
      {"one name twice", change([](Piece& p) { p.outline.edges[1].name = p.outline.edges[0].name; })},
      {"a hole without edges", change([](Piece& p) { p.holes.emplace_back(); })},
      {"a notch on no edge", change([](Piece& p) {
         p.marks.push_back({"n", "nowhere", 0.5, {}});
       })},
      {"a notch beyond its edge", change([](Piece& p) {
         p.marks.push_back({"n", p.outline.edges[0].name, 7, {}});
       })},
      {"no grain", change([](Piece& p) { p.grain = {}; })},
      {"no such fabric", change([](Piece& p) { p.fabric = "moonlight"; })},
      {"a layer far out", change([](Piece& p) { p.layer = 1 << 30; })},
      {"a pose of zeros", change([](Piece& p) {
         p.pose = {0, 0, 0, 0, {}};
       })},
      {"far away", change([](Piece& p) {
         p.pose.carry = {1e9, 0, 0};
       })},
      {"a form without faces", change(form([](Form& f) { f.faces.clear(); }))},
      {"a form far away", change(form([](Form& f) {
         f.space[0] = {1e200, 0, 0};
       }))},
      {"a seam without an edge", [](Document& d) { d.pattern.seams.begin()->second.a[0].edge = "nowhere"; }},
      {"a seam of nothing", [](Document& d) { d.pattern.seams.begin()->second.a.clear(); }},
      {"a seam backwards", [](Document& d) { d.pattern.seams.begin()->second.a[0].from = 2; }},
      {"a pin on no piece",
       [](Document& d) {
         d.pins[PieceId{999}] = {{0, 0}};
       }},
      {"threads one upon another", [](Document& d) { d.settings.spacing = 0; }},
  };
  const std::string good = bytes();
  for (const auto& [name, edit] : forgeries) {
    SCOPED_TRACE(name);
    write(good);
    Document forged = whole_;
    edit(forged);
    forge(forged);
    const auto file = DocumentFile::open(path_, &room_.context);
    ASSERT_TRUE(file) << text(file.error().what);
    EXPECT_EQ(hash(file->document()), hash(whole_));
    EXPECT_THAT(remarks(*file), Contains(HasSubstr("step 5 is damaged; it was made again")));
    if (hash(forged) != hash(whole_)) {
      EXPECT_THAT(remarks(*file), Contains(HasSubstr("another pattern than the file says")));
    }
  }
}

TEST_F(TamperedDocument, AStepThatDoesNotFollowIsTold) {
  StepRow row = rows()[2];
  row.before = std::string(32, '0');
  put(row);
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("Step 3 does not begin where the step before it ends")));
}

TEST_F(TamperedDocument, AStepTakenOutIsTold) {
  const std::vector<StepRow> before = rows();
  StepRow last = before[4];
  sql("DELETE FROM op WHERE seq = 4");
  last.parent = 3, last.serial = 4;
  last.chain = chained(before[2].chain, steps_[4].operation);
  put(last);
  const auto file = DocumentFile::open(path_, &room_.context);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_THAT(remarks(*file), Not(IsEmpty()));
}

TEST_F(TamperedDocument, AStepTakenOutLeavesWhatCanStillBeReachedInTheRescuedFile) {
  const fs::path saved = folder_ / "saved.karinui";
  const std::vector<StepRow> before = rows();
  std::string chain = before[0].chain;  // without the second piece, all seals made anew
  sql("DELETE FROM op WHERE seq = 2");
  for (std::size_t i = 2; i < before.size(); ++i) {
    StepRow row = before[i];
    chain = row.chain = chained(chain, steps_[i].operation);
    if (i == 2) row.parent = 1, row.before = before[0].after;
    --row.serial;
    put(row);
  }
  sql("DELETE FROM snap WHERE seq > 1");
  ASSERT_FALSE(DocumentFile::open(path_, &room_.context)) << "the seam's piece is gone";
  const auto rescued = rescue(path_, saved, room_.context);
  ASSERT_TRUE(rescued) << text(rescued.error().what);
  EXPECT_EQ(rescued->steps, 1u);
  EXPECT_EQ(rescued->lost, 3u);
  const auto file = DocumentFile::open(saved);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), steps_[0].after);
}

TEST_F(TamperedDocument, AMiddleStepWhoseHashesLieTogetherIsTold) {
  StepRow middle = rows()[2], next = rows()[3];
  middle.after = next.before = std::string(32, '0');
  put(middle), put(next);
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("keeps of step 3 is damaged; it is made again")));
}

TEST_F(TamperedDocument, AHashOfHowClothStandsThatLiesInTheMiddleIsTold) {
  StepRow middle = rows()[1];
  middle.stand = std::string(32, '0');
  put(middle);
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("keeps of step 2 is damaged; it is made again")));
}

TEST_F(TamperedDocument, KeptBytesOfAMiddleStepThatWereChangedAreTold) {
  sql("UPDATE blob SET bytes = x'00' WHERE hash = (SELECT blob FROM snap WHERE seq = 2 AND part = 'rest')");
  const auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("keeps of step 2 is damaged; it is made again")));
  EXPECT_EQ(hash(file->document()), hash(whole_));
}

// Every hash and seal holds, only the words are others: what is kept was made by another operation.
TEST_F(TamperedDocument, AnOperationOfOtherWordsIsToldByTakingTheStepsOnceMore) {
  auto quiet = DocumentFile::open(path_);
  ASSERT_TRUE(quiet && quiet->checkSteps(room_.context));
  EXPECT_THAT(remarks(*quiet), IsEmpty());
  quiet = DocumentFile::inMemory();  // closes it
  std::vector<StepRow> all = rows();
  std::string chain = all[1].chain;
  for (std::size_t i = 2; i < all.size(); ++i) {
    auto operation = steps_[i].operation;
    if (i == 2) {
      Choice& turned = std::get<SewEdges>(operation).reversed;
      turned = turned == Choice::Yes ? Choice::No : Choice::Yes;
    }
    const std::string words = text(operation), kind(nameOf(operation));
    all[i].chain = chain = chained(chain, operation);
    sql("UPDATE op SET args = '" + (words.size() > kind.size() ? words.substr(kind.size() + 1) : "") +
        "' WHERE seq = " + std::to_string(all[i].seq));
    all[i].args = words.size() > kind.size() ? words.substr(kind.size() + 1) : "";
    put(all[i]);
  }
  auto file = DocumentFile::open(path_);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_THAT(remarks(*file), IsEmpty()) << "nothing that opening looks at is changed";
  ASSERT_TRUE(file->checkSteps(room_.context));
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("Step 3, “sew”, leads to another garment than the file keeps")));
}

// Another figure, with every hash and seal made anew. Opening makes no figure and cannot know; who checks does. An
// imported body, and at length one of measures, which takes longer to be made.
TEST_F(TamperedDocument, AFigureThatIsNotWhatItIsMadeOfIsToldByTakingTheStepsOnceMore) {
  const std::string mesh = "body mesh=" + *room_.blobs.put(packBody(egg()));
  for (const std::string& body : atLength() ? std::vector<std::string>{mesh, "body size=jis9ar"} : std::vector{mesh}) {
    SCOPED_TRACE(body);
    fs::remove(path_);
    {
      auto file = DocumentFile::create(path_);
      ASSERT_TRUE(file && room_.play(*file, body + "\nset spacing=20mm\n"));
      whole_ = file->document();
      ASSERT_TRUE(file->checkSteps(room_.context));
      EXPECT_THAT(remarks(*file), IsEmpty());
    }
    const std::string good = bytes();
    const BodyPtr worn = room_.bodies.known(whole_.body.hash);
    ASSERT_TRUE(worn);
    // The document kept beside both steps, with this figure.
    const auto forge = [&](const std::function<void(BodyChoice&)>& edit, const std::string& figure) {
      write(good);
      std::string before = hash(Document());
      for (const StepRow& row : rows()) {
        Document forged = whole_;
        forged.operations = row.serial;
        if (row.seq == 1) forged.settings = {};
        edit(forged.body);
        keep("rest", packRest(forged), static_cast<int>(row.seq));
        keep("figure", figure, static_cast<int>(row.seq));
        StepRow now = row;
        now.before = before, now.after = before = hash(forged), now.stand = drapeHash(forged);
        put(now);
      }
    };
    Body::Parts wide;
    wide.name = worn->name(), wide.mesh = worn->mesh(), wide.measured = worn->measured();
    wide.landmarks = worn->landmarks(), wide.chart = Body::chartFrom(worn->chartNumbers());
    for (Vec3& p : wide.mesh.points) p.x *= 1.1;
    const BodyPtr other = *Body::make(wide);
    wide.mesh = worn->mesh(), wide.name = "somebody else";
    const BodyPtr named = *Body::make(wide);
    std::vector<std::tuple<const char*, std::function<void(BodyChoice&)>, BodyPtr>> forgeries{
        {"other points", [&](BodyChoice& choice) { choice.hash = other->hash(); }, other},
        {"other words beside the same points", [](BodyChoice&) {}, named}};
    if (whole_.body.mesh.empty()) {
      const auto size = *builtInSize("eu38");
      const BodyPtr large = *makeMannequin(size, room_.workers, room_.token);
      forgeries.emplace_back(
          "other measures, and their figure",
          [=](BodyChoice& choice) { choice.measurements = size, choice.hash = large->hash(); }, large);
    }
    for (const auto& [name, edit, figure] : forgeries) {
      SCOPED_TRACE(name);
      forge(edit, packFigure(*figure));
      {
        auto file = DocumentFile::open(path_);
        ASSERT_TRUE(file) << text(file.error().what);
        EXPECT_THAT(remarks(*file), IsEmpty()) << "nothing that opening looks at is changed";
        ASSERT_TRUE(file->checkSteps(room_.context));
        EXPECT_THAT(remarks(*file), ElementsAre(HasSubstr("The figure kept with step 1 is not the one")));
      }
      const fs::path saved = folder_ / "saved.karinui";
      const auto rescued = rescue(path_, saved, room_.context);
      ASSERT_TRUE(rescued) << text(rescued.error().what);
      EXPECT_EQ(rescued->remarks.size(), 1u);
      fs::remove(saved);
    }
  }
}

TEST_F(TamperedDocument, KeptBytesThatWereChangedAreTold) {
  sql("UPDATE blob SET bytes = x'00' WHERE hash = (SELECT blob FROM snap WHERE seq = 5 AND part = 'rest')");
  const auto file = DocumentFile::open(path_, &room_.context);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), hash(whole_));
  EXPECT_THAT(remarks(*file), Contains(HasSubstr("step 5 is damaged; it was made again")));
}

TEST_F(TamperedDocument, AGarmentKeptBeyondALostStepIsMadeAnew) {
  const fs::path saved = folder_ / "saved.karinui";
  sql("UPDATE op SET args = 'ease=2mm' WHERE seq = 3");
  const auto rescued = rescue(path_, saved, room_.context);
  ASSERT_TRUE(rescued) << text(rescued.error().what);
  const auto file = DocumentFile::open(saved);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(rescued->anew, file->steps().size());
  EXPECT_EQ(rescued->lost, 5u);
  ASSERT_EQ(file->document().pattern.pieces.size(), 2u);
  for (const auto& [id, piece] : whole_.pattern.pieces)
    EXPECT_EQ(file->document().pieceNamed(piece->name)->outline, piece->outline);
  ASSERT_EQ(file->document().pattern.seams.size(), 1u);
  EXPECT_EQ(file->document().settings, whole_.settings);
}

TEST_F(TamperedDocument, WhatIsWholeIsSavedToANewFile) {
  const fs::path saved = folder_ / "saved.karinui";
  sql("UPDATE op SET args = 'ease=2mm' WHERE seq = 3; DELETE FROM snap WHERE seq > 2");
  ASSERT_FALSE(DocumentFile::open(path_));
  const std::string damaged = bytes();
  const auto rescued = rescue(path_, saved, room_.context);
  ASSERT_TRUE(rescued) << text(rescued.error().what);
  EXPECT_EQ(rescued->steps, 2u);
  EXPECT_EQ(rescued->lost, 3u);
  EXPECT_EQ(bytes(), damaged);
  const auto file = DocumentFile::open(saved);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), steps_[1].after);
  EXPECT_THAT(remarks(*file), IsEmpty());
  EXPECT_THAT(text(rescue(path_, saved, room_.context).error().what), HasSubstr("There is already a file"));
}

TEST_F(TamperedDocument, AWholeFileIsSavedWholeWithoutDrapingAgain) {
  const fs::path saved = folder_ / "saved.karinui";
  const auto rescued = rescue(path_, saved, room_.context);
  ASSERT_TRUE(rescued);
  EXPECT_EQ(rescued->lost, 0u);
  const auto file = DocumentFile::open(saved);
  ASSERT_TRUE(file);
  EXPECT_EQ(drapeHash(file->document()), drapeHash(whole_));
  EXPECT_THAT(remarks(*file), IsEmpty());
}

// What opening advises is not advised again by what was advised.
TEST_F(TamperedDocument, WhatCannotBeReadAtAllIsSaidToBeLost) {
  write(bytes().substr(0, bytes().size() / 2));
  EXPECT_THAT(text(DocumentFile::open(path_).error().what), HasSubstr("karinui rescue"));
  const auto rescued = rescue(path_, folder_ / "saved.karinui", room_.context);
  ASSERT_FALSE(rescued);
  EXPECT_THAT(text(rescued.error().what), HasSubstr("Take an older copy"));
  EXPECT_FALSE(fs::exists(folder_ / "saved.karinui"));
}

// Whoever opens the document makes the part anew; a dump would refuse its name.
TEST_F(TamperedDocument, APartOfADamagedNameIsNotSaved) {
  const fs::path saved = folder_ / "saved.karinui";
  sql("UPDATE snap SET part = 'r^st' WHERE seq = 2 AND part = 'rest'");
  ASSERT_TRUE(rescue(path_, saved, room_.context));
  const auto dump = dumped(saved);
  ASSERT_TRUE(dump) << text(dump.error().what);
  const auto file = DocumentFile::open(saved, &room_.context);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), hash(whole_));
}

// What comes out is always a beginning of what was, or the garment that was kept last.
TEST_F(TamperedDocument, DamagedBytesAreSavedAsFarAsTheyAreWhole) {
  const std::string good = bytes();
  std::map<std::string, std::string> known{{"", hash(Document())}};
  for (const Step& s : steps_) known[s.chain] = s.after;
  std::mt19937_64 dice(2611);
  std::size_t saved = 0;
  for (int seed = 0; seed < soak(60); ++seed) {
    std::string bad = good;
    for (std::size_t i = 0, n = 1 + dice() % 60; i < n; ++i)
      bad[512 + dice() % (bad.size() - 512)] ^= static_cast<char>(1 + dice() % 255);
    write(bad);
    const fs::path to = folder_ / ("saved" + std::to_string(seed) + ".karinui");
    const auto rescued = rescue(path_, to, room_.context);
    if (!rescued) {
      EXPECT_FALSE(text(rescued.error().what).empty());
      EXPECT_FALSE(fs::exists(to)) << seed;
      continue;
    }
    const auto file = DocumentFile::open(to, &room_.context);
    ASSERT_TRUE(file) << seed << ": " << text(file.error().what);
    ++saved;
    if (rescued->anew > 0) {
      for (const auto& [id, piece] : file->document().pattern.pieces) {
        const Piece* was = whole_.pieceNamed(piece->name);
        ASSERT_TRUE(was) << seed;
        EXPECT_EQ(piece->outline, was->outline) << seed;
      }
      continue;
    }
    EXPECT_EQ(hash(file->document()), known.at(file->steps().empty() ? "" : file->steps().back().chain)) << seed;
  }
  EXPECT_GT(saved, 0u);
}

}  // namespace
}  // namespace karinui
