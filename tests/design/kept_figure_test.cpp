// A figure is built once; after that the document keeps it.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>

#include "design/workroom.h"
#include "karinui/body/sizes.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

class KeptFigure : public ::testing::Test {
 protected:
  KeptFigure() {
    ::unsetenv("KARINUI_FIGURES");
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "shirt.karinui";
    Workroom room;
    auto file = DocumentFile::create(path_);
    EXPECT_TRUE(file && room.play(*file, "body size=jis9ar"));
    document_ = hash(file->document());
    body_ = file->document().body.hash;
  }
  ~KeptFigure() override { fs::remove_all(folder_); }

  void sql(const char* text) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &db), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(db, text, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }

  // Opens the document as another program would and asks for its figure. True: it had to be built.
  bool builds(const std::string& then = {}) const {
    Workers workers(1);
    bool built = false;
    const Token token([&](double, const Message&) { built = true; });
    auto file = DocumentFile::open(path_);
    EXPECT_TRUE(file) << text(file.error().what);
    Bodies bodies;
    Context context{workers, token, file->blobs(), bodies, {}, {}};
    const auto body = bodyOf(file->document(), context);
    EXPECT_TRUE(body && (*body)->hash() == body_);
    EXPECT_EQ(hash(file->document()), document_);
    if (!then.empty()) {
      EXPECT_TRUE(file->perform(*parseOperation(then), context));
    }
    return built;
  }

  fs::path folder_, path_;
  std::string document_, body_;
};

TEST_F(KeptFigure, IsNotBuiltAgain) { EXPECT_FALSE(builds()); }

TEST_F(KeptFigure, IsBuiltSilentlyWhereItIsLostAndKeptAnew) {
  sql("DELETE FROM blob WHERE hash IN (SELECT blob FROM snap WHERE part = 'figure')");
  EXPECT_TRUE(builds("set spacing=10mm"));
  EXPECT_FALSE(builds());
}

TEST_F(KeptFigure, IsBuiltSilentlyWhereItIsDamagedAndKeptAnew) {
  sql("UPDATE blob SET bytes = substr(bytes, 1, 5000) WHERE hash IN (SELECT blob FROM snap WHERE part = 'figure')");
  EXPECT_TRUE(builds("set spacing=10mm"));
  EXPECT_FALSE(builds());
}

TEST_F(KeptFigure, IsTheSameFigure) {
  Workroom room;
  auto file = *DocumentFile::open(path_);
  const auto kept = unpackFigure(*file.blobs().figure(body_));
  ASSERT_TRUE(kept);
  const auto made = makeMannequin(*builtInSize("jis9ar"), room.workers, room.token);
  ASSERT_TRUE(made);
  EXPECT_EQ((*kept)->hash(), (*made)->hash());
  EXPECT_EQ((*kept)->measured(), (*made)->measured());
  EXPECT_EQ((*kept)->chartNumbers(), (*made)->chartNumbers());
  EXPECT_EQ(packFigure(**kept), packFigure(**made));
}

TEST_F(KeptFigure, MayBeADressForm) {
  Workroom room;
  std::string form;
  {
    auto file = *DocumentFile::open(path_);
    ASSERT_TRUE(room.play(file, "body size=jis9ar form=yes"));
    form = file.document().body.hash;
    EXPECT_NE(form, body_);
  }
  auto again = *DocumentFile::open(path_);
  EXPECT_TRUE(again.document().body.form);
  EXPECT_EQ(again.document().body.hash, form);
  const auto kept = unpackFigure(*again.blobs().figure(form));
  ASSERT_TRUE(kept);
  EXPECT_EQ((*kept)->hash(), form);
  EXPECT_FALSE((*kept)->landmarks().contains("wrist_left"));
  ASSERT_TRUE(room.play(again, "body size=jis9ar"));
  EXPECT_FALSE(again.document().body.form);
  EXPECT_EQ(again.document().body.hash, body_);
}

// A document made when mannequins had other ends, whose figure was lost: its drapes fit the former one.
TEST(LostFigure, IsMadeAsItWas) {
  Workroom room;
  const auto size = *builtInSize("jis9ar");
  const auto drawn = makeMannequin(size, room.workers, room.token, MannequinEnds::Drawn);
  ASSERT_TRUE(drawn);
  EXPECT_EQ((*drawn)->hash(), "48c7e36c51f7816795b79d6c695ba480");
  BodyChoice choice;
  choice.measurements = size;
  MemoryBlobs none;
  Bodies bodies;
  const auto now = bodies.find(choice, none, room.workers, room.token);
  ASSERT_TRUE(now);
  EXPECT_NE((*now)->hash(), (*drawn)->hash());
  choice.hash = (*drawn)->hash();
  for (int asked = 0; asked < 2; ++asked) {
    const auto found = bodies.find(choice, none, room.workers, room.token);
    ASSERT_TRUE(found);
    EXPECT_EQ((*found)->hash(), choice.hash);
  }
}

TEST(PackedFigure, DamagedBytesAreRefused) {
  const auto body = Body::make(egg());
  ASSERT_TRUE(body);
  const std::string bytes = packFigure(**body);
  EXPECT_TRUE(unpackFigure(bytes));
  for (std::size_t size = 0; size < bytes.size(); size += 97) EXPECT_FALSE(unpackFigure(bytes.substr(0, size)));
  EXPECT_FALSE(unpackFigure(bytes + "x"));
}

}  // namespace
}  // namespace karinui
