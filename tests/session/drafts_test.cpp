// Nothing is ever only in memory: a document without a file becomes a draft with its first step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "design/workroom.h"
#include "karinui/base/file.h"
#include "karinui/exchange/spatial.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Drafts : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("karinui_drafts_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path drafts() const { return folder_ / "Drafts"; }
  SessionOptions options() const {
    SessionOptions options;
    options.drafts = drafts();
    options.nameDraft = [](const std::string& about) { return about.empty() ? "Draft today" : about + " today"; };
    options.drape = [](const Document& d, const DrapePieces& op, Context&) { return fallABit(d, op.live); };
    return options;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> all;
    if (fs::exists(drafts()))
      for (const auto& entry : fs::directory_iterator(drafts())) all.push_back(entry.path().filename().string());
    std::sort(all.begin(), all.end());
    return all;
  }
  static void perform(Session& session, const char* line) {
    session.perform(*parseOperation(line));
    session.finish();
  }
  static std::string refused(Session& session) {
    std::string all;
    for (const Notice& notice : session.takeNotices())
      if (notice.kind == Notice::Kind::Refused) all += text(notice.what);
    return all;
  }
  static constexpr const char* kPiece = "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\"";
  fs::path folder_;
};

TEST_F(Drafts, TheFirstStepMakesTheFileAndTheNextDocumentAnother) {
  {
    Session session(options());
    session.finish();
    EXPECT_TRUE(files().empty()) << "no step, no file";
    perform(session, kPiece);
    EXPECT_EQ(session.path(), drafts() / "Draft today.karinui") << refused(session);
    EXPECT_TRUE(session.draft());
    session.begin(DocumentFile::inMemory());
    perform(session, "body size=jis9ar");
    EXPECT_EQ(session.path(), drafts() / "jis9ar today.karinui");
    session.begin(DocumentFile::inMemory());
    perform(session, kPiece);
    EXPECT_EQ(session.path(), drafts() / "Draft today 2.karinui") << "the name was taken";
  }
  EXPECT_EQ(files().size(), 3u) << "one whole file each";
  const auto kept = DocumentFile::open(drafts() / "Draft today.karinui");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->steps().size(), 1u);
}

TEST_F(Drafts, ARefusedFirstStepLeavesNoFile) {
  Session session(options());
  perform(session, "drape");
  EXPECT_NE(refused(session), "");
  perform(session, "remove piece=nobody");
  session.importPattern(folder_ / "none.svg");
  session.importBody(folder_ / "none.obj");
  session.finish();
  EXPECT_TRUE(files().empty());
  EXPECT_TRUE(session.path().empty());
  perform(session, kPiece);
  EXPECT_TRUE(fs::exists(drafts() / "Draft today.karinui")) << "and the next one is kept";
}

// What was guessed of a pattern is said with it.
TEST_F(Drafts, NotesOnAPatternAreSaid) {
  ASSERT_TRUE(writeFile(folder_ / "front.svg", "<svg viewBox='0 0 900 900'><rect width='400' height='300'/></svg>"));
  Session session(options());
  session.importPattern(folder_ / "front.svg");
  session.finish();
  std::string said;
  for (const Notice& notice : session.takeNotices()) said += text(notice.what) + "\n";
  EXPECT_THAT(said, testing::HasSubstr("a unit was read as a pixel, 96 to the inch"));
  EXPECT_EQ(session.snapshot().document.pattern.pieces.size(), 1u);
}

// A pattern whose file tells no unit is read once more in the right one, in place of what was read.
TEST_F(Drafts, AGuessedUnitIsAskedFor) {
  ASSERT_TRUE(writeFile(folder_ / "front.svg", "<svg viewBox='0 0 900 900'><rect width='400' height='300'/></svg>"));
  ASSERT_TRUE(
      writeFile(folder_ / "told.svg",
                "<svg width='900mm' height='900mm' viewBox='0 0 900 900'><rect width='400' height='300'/></svg>"));
  Session session(options());
  session.importPattern(folder_ / "told.svg");
  session.finish();
  EXPECT_FALSE(session.takeGuessedUnit());
  const auto area = [&] {
    double all = 0;
    for (const auto& [id, piece] : session.snapshot().document.pattern.pieces) all += piece->outline.area();
    return all;
  };
  EXPECT_NEAR(area(), 0.12, 1e-9);
  session.importPattern(folder_ / "front.svg");
  session.finish();
  const auto guessed = session.takeGuessedUnit();
  ASSERT_TRUE(guessed);
  EXPECT_FALSE(session.takeGuessedUnit()) << "told once";
  EXPECT_NEAR(guessed->longest, 0.4 * 25.4 / 96, 1e-9);
  EXPECT_NEAR(guessed->unit, 0.0254 / 96, 1e-12);
  const std::size_t steps = session.steps().size();
  session.readAgain(*guessed, "ell");
  session.finish();
  EXPECT_THAT(refused(session), testing::HasSubstr("“ell” is not one of"));
  EXPECT_EQ(session.steps().size(), steps) << "what was read stays";
  session.readAgain(*guessed, "mm");
  session.finish();
  EXPECT_EQ(refused(session), "");
  EXPECT_NEAR(area(), 0.24, 1e-9);
  EXPECT_EQ(session.steps().size(), steps);
  EXPECT_FALSE(session.takeGuessedUnit());
  session.readAgain(*guessed, "cm");
  session.finish();
  EXPECT_THAT(refused(session), testing::HasSubstr("gone on since"));
  EXPECT_NEAR(area(), 0.24, 1e-9);
}

std::string polylineOf(const char* layer, double from, double to) {
  std::string all = std::string("0\nPOLYLINE\n8\n") + layer + "\n66\n1\n70\n1\n";
  for (const auto& [x, y] : {std::pair{from, from}, {to, from}, {to, to}, {from, to}})
    all += "0\nVERTEX\n8\n1\n10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n";
  return all + "0\nSEQEND\n";
}
// The second piece cannot be made: its hole lies beside it. The first one does not stay alone.
TEST_F(Drafts, APatternComesWholeOrNotAtAll) {
  const auto block = [](const std::string& name, const std::string& drawn) {
    return "0\nBLOCK\n8\n0\n2\n" + name + "\n10\n0\n20\n0\n" + drawn + "0\nENDBLK\n";
  };
  const std::string dxf = "0\nSECTION\n2\nBLOCKS\n" + block("FRONT", polylineOf("1", 0, 400)) +
                          block("BACK", polylineOf("1", 0, 400) + polylineOf("11", 500, 600)) +
                          "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nTEXT\n8\n1\n1\nUnits: METRIC\n0\nENDSEC\n0\nEOF\n";
  ASSERT_TRUE(writeFile(folder_ / "style.dxf", dxf));
  Session session(options());
  perform(session, kPiece);
  const auto before = session.snapshot().document.pattern.pieces.size();
  session.importPattern(folder_ / "style.dxf");
  session.finish();
  EXPECT_THAT(refused(session), testing::HasSubstr("not inside its outline"));
  EXPECT_EQ(session.snapshot().document.pattern.pieces.size(), before);
  EXPECT_EQ(session.steps().size(), 1u);
}

std::string objOf(const TriangleMesh& mesh) {
  std::string obj;
  for (const Vec3 p : mesh.points)
    obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (const Triangle& f : mesh.faces)
    obj += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[2] + 1) + "\n";
  return obj;
}

// A scan has holes: what is refused is offered with a skin, and what was done to it is told.
TEST_F(Drafts, ABodyWithAHoleIsTakenWithASkinOverIt) {
  TriangleMesh mesh = egg().mesh;
  mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(mesh.faces.size() / 2));
  ASSERT_TRUE(writeFile(folder_ / "scan.obj", objOf(mesh)));
  Session session(options());
  session.importBody(folder_ / "scan.obj");
  session.finish();
  EXPECT_THAT(refused(session), testing::HasSubstr("not closed"));
  EXPECT_EQ(session.takeOpenBody(), folder_ / "scan.obj");
  EXPECT_FALSE(session.takeOpenBody()) << "told once";
  EXPECT_FALSE(session.snapshot().body);
  session.importBody(folder_ / "none.obj");
  session.finish();
  EXPECT_NE(refused(session), "");
  EXPECT_FALSE(session.takeOpenBody()) << "no skin makes a file";
  session.importBody(folder_ / "scan.obj", true);
  session.finish();
  std::string said;
  for (const Notice& notice : session.takeNotices()) {
    EXPECT_NE(notice.kind, Notice::Kind::Refused) << text(notice.what);
    said += text(notice.what) + "\n";
  }
  EXPECT_THAT(said, testing::HasSubstr("Wrapped in a watertight skin"));
  ASSERT_TRUE(session.snapshot().body);
  EXPECT_FALSE(session.takeOpenBody());
}

TEST_F(Drafts, WhatIsImportedIntoAnEmptyWindowIsADraftOfItsName) {
  ASSERT_TRUE(writeFile(folder_ / "shirt.ops", kTwoPieces));
  ASSERT_TRUE(writeFile(folder_ / "egg.obj", objOf(egg().mesh)));
  {
    Session session(options());
    session.importPattern(folder_ / "shirt.ops");
    session.finish();
    EXPECT_EQ(session.path(), drafts() / "shirt today.karinui") << refused(session);
    session.begin(DocumentFile::inMemory());
    session.importBody(folder_ / "egg.obj");
    session.finish();
    EXPECT_EQ(session.path(), drafts() / "egg today.karinui") << refused(session);
  }
  Session again(options());
  again.open(drafts() / "egg today.karinui");
  again.finish();
  ASSERT_TRUE(again.snapshot().body) << refused(again) << "the mesh is in the file";
  EXPECT_EQ(again.snapshot().body->name(), "egg");
}

// Its pixels lie in the draft that the step is written into.
TEST_F(Drafts, APhotographMayBeTheFirstThingDone) {
  constexpr char kPng[] =  // two by two red pixels
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00\x00\x02"
      "\x08\x02\x00\x00\x00\xfd\xd4\x9a\x73\x00\x00\x00\x10\x49\x44\x41\x54\x78\x9c\x63\x38\x21\x27\x07"
      "\x44\x0c\x10\x0a\x00\x1f\x26\x04\x11\xa2\x8f\x22\xaf\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60"
      "\x82";
  ASSERT_TRUE(writeFile(folder_ / "rose.png", std::string_view(kPng, sizeof kPng - 1)));
  Session session(options());
  SetLook look;
  look.fabric = "cotton";
  session.importPrint(folder_ / "rose.png", look);
  session.finish();
  EXPECT_EQ(refused(session), "");
  EXPECT_EQ(session.steps().size(), 1u);
  EXPECT_EQ(session.path(), drafts() / "Draft today.karinui");
  look.fabric = "nothing of the kind";
  session.begin(DocumentFile::inMemory());
  session.importPrint(folder_ / "rose.png", look);
  session.finish();
  EXPECT_NE(refused(session), "");
  EXPECT_EQ(files().size(), 1u) << "and one that is refused leaves no file";
}

// An ending in capital letters is the same ending; the operations are not taken for JSON.
TEST_F(Drafts, AnEndingIsReadInAnyLetterCaseAndAnUnknownOneRefused) {
  ASSERT_TRUE(writeFile(folder_ / "X.OPS", kTwoPieces));
  ASSERT_TRUE(writeFile(folder_ / "shirt.txt", kTwoPieces));
  Session session(options());
  session.importPattern(folder_ / "X.OPS");
  session.finish();
  EXPECT_EQ(session.snapshot().document.pattern.pieces.size(), 2u) << refused(session);
  session.importPattern(folder_ / "shirt.txt");
  session.finish();
  EXPECT_THAT(refused(session), HasSubstr("patterns (.svg, .json, .dxf), scripts of operations (.ops)"));
  EXPECT_EQ(session.snapshot().document.pattern.pieces.size(), 2u);
}

TEST_F(Drafts, SaveAsMovesADraftAndCopiesADocument) {
  Session session(options());
  perform(session, kPiece);
  session.saveAs(folder_ / "coat.karinui");
  session.finish();
  EXPECT_EQ(session.path(), folder_ / "coat.karinui") << refused(session);
  EXPECT_FALSE(session.draft());
  EXPECT_TRUE(files().empty()) << "no stale draft stays";
  perform(session, "rename piece=front to=back");
  session.saveAs(folder_ / "copy.karinui");
  session.saveAs(folder_ / "copy.karinui");  // where it is already
  session.finish();
  EXPECT_EQ(session.steps().size(), 2u) << refused(session);
  EXPECT_TRUE(fs::exists(folder_ / "coat.karinui"));
  EXPECT_EQ(session.path(), folder_ / "copy.karinui");
  constexpr auto kOthers = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(session.path()).permissions() & kOthers, fs::perms::none) << "it tells a person's measures";
}

// A stick that is pulled out, a folder that is tidied up: the garment in the window is all there is.
TEST_F(Drafts, WhatWasMovedOrDeletedWhileItIsOpenIsToldAndCanBeKept) {
  for (const bool draft : {false, true}) {
    Session session(options());
    perform(session, kPiece);
    if (!draft) session.saveAs(folder_ / "coat.karinui");
    session.finish();
    const fs::path was = session.path();
    fs::remove(was);
    perform(session, "rename piece=front to=back");
    EXPECT_THAT(refused(session), HasSubstr("was moved, renamed or deleted while it is open here"));
    session.saveAs(folder_ / "no such folder" / "kept.karinui");
    session.finish();
    EXPECT_NE(refused(session), "");
    EXPECT_EQ(session.steps().size(), 1u) << "what cannot be kept there is still in the hand";
    const fs::path kept = folder_ / (draft ? "kept draft.karinui" : "kept.karinui");
    session.saveAs(kept);
    session.finish();
    EXPECT_EQ(refused(session), "");
    EXPECT_EQ(session.path(), kept);
    perform(session, "rename piece=front to=back");
    EXPECT_EQ(session.steps().size(), 2u) << refused(session);
    EXPECT_FALSE(fs::exists(was));
  }
  // Another document lies where this one lay; that one is let be.
  Session session(options());
  perform(session, kPiece);
  const fs::path was = session.path();
  fs::rename(was, folder_ / "elsewhere.karinui");
  ASSERT_TRUE(writeFile(was, "another"));
  session.saveAs(folder_ / "mine.karinui");
  session.finish();
  EXPECT_EQ(session.path(), folder_ / "mine.karinui") << refused(session);
  EXPECT_EQ(*readFile(was), "another");
}

// The place where it was, which is free again.
TEST_F(Drafts, WhatWasDeletedIsKeptWhereItWas) {
  Session session(options());
  perform(session, kPiece);
  session.saveAs(folder_ / "coat.karinui");
  session.finish();
  fs::remove(folder_ / "coat.karinui");
  session.saveAs(folder_ / "coat.karinui");
  perform(session, "rename piece=front to=back");
  EXPECT_EQ(refused(session), "");
  EXPECT_EQ(session.steps().size(), 2u);
  EXPECT_TRUE(fs::exists(folder_ / "coat.karinui"));
}

TEST_F(Drafts, WhereNoneCanBeWrittenTheStepIsRefusedUntilAPlaceIsChosen) {
  ASSERT_TRUE(writeFile(drafts(), "a file where the folder should be"));
  Session session(options());
  perform(session, kPiece);
  EXPECT_THAT(refused(session), testing::HasSubstr("no file can be made there"));
  EXPECT_TRUE(session.steps().empty()) << "never silently in memory";
  session.saveAs(folder_ / "coat.karinui");
  perform(session, kPiece);
  EXPECT_EQ(session.steps().size(), 1u) << refused(session);
  EXPECT_EQ(session.path(), folder_ / "coat.karinui");
}

// Leaving: what was asked for is done first.
TEST_F(Drafts, AStepThatWaitsIsWrittenBeforeLeaving) {
  {
    Session session(options());
    session.perform(*parseOperation("body size=jis9ar"));
    session.perform(*parseOperation(kPiece));
    session.close();
  }
  ASSERT_EQ(files().size(), 1u);
  const auto kept = DocumentFile::openForReading(drafts() / files().front());
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->steps().size(), 2u);
}

TEST_F(Drafts, ThePatternIsSharedWhileTheDocumentIsOpen) {
  Session session(options());
  perform(session, "variable name=cuff value=9cm");
  perform(session, kPiece);
  const fs::path given = folder_ / "given.karinui";
  session.shareTo(given);
  session.finish();
  std::string said;
  for (const Notice& notice : session.takeNotices()) said += text(notice.what) + "\n";
  EXPECT_THAT(said, HasSubstr("given.karinui” was written."));
  EXPECT_THAT(
      said, HasSubstr("The names stay, of pieces, seams, fabrics, fastenings, sizes, lines, notches and edges: front"));
  const auto shared = DocumentFile::openForReading(given);
  ASSERT_TRUE(shared) << text(shared.error().what);
  EXPECT_EQ(shared->document().pattern.pieces.size(), 1u);
  EXPECT_TRUE(shared->document().variables.empty());
  session.shareTo(session.path());
  session.finish();
  EXPECT_THAT(refused(session), HasSubstr("the document itself"));
  EXPECT_EQ(session.snapshot().document.variables.size(), 1u);
  perform(session, "set ease=1cm");
  EXPECT_EQ(refused(session), "") << "and work goes on";
}

// What was begun with a figure is called after what is made for it, and follows the figure until a person names it.
TEST_F(Drafts, AreCalledAfterTheGarment) {
  SessionOptions named = options();
  named.nameGarment = [](const Document& made, const Operation& by) {
    return std::holds_alternative<DraftBlock>(static_cast<const PlainOperation&>(by)) ? "Skirt " + made.body.size : "";
  };
  Session session(named);
  perform(session, "body size=jis9ar");
  EXPECT_EQ(session.path(), drafts() / "jis9ar today.karinui");
  perform(session, "block kind=skirt");
  EXPECT_EQ(session.path(), drafts() / "Skirt jis9ar.karinui") << refused(session);
  EXPECT_TRUE(session.draft());
  const std::size_t steps = session.steps().size();
  session.amend(1, *parseOperation("body size=eu44w"));
  session.finish();
  EXPECT_EQ(session.path(), drafts() / "Skirt eu44w.karinui") << refused(session);
  perform(session, "set ease=1cm");
  for (const std::string& file : files()) EXPECT_THAT(file, testing::StartsWith("Skirt eu44w.")) << "one document";
  session.command(Command::Undo);
  session.finish();
  EXPECT_EQ(session.steps().size(), steps) << "undo goes on in the renamed file";
  session.saveAs(folder_ / "mine.karinui");
  session.finish();
  session.amend(1, *parseOperation("body size=jis9ar"));
  session.finish();
  EXPECT_EQ(session.path(), folder_ / "mine.karinui") << "a name that was chosen stays";
  session.begin(DocumentFile::inMemory());
  perform(session, kPiece);
  EXPECT_EQ(session.path(), drafts() / "Draft today.karinui") << "a piece is no garment";
}

}  // namespace
}  // namespace karinui
