// Going back in the tree of steps, and changing an earlier step: all of it or none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> linesOf(const DocumentFile& file) {
  std::vector<std::string> all;
  for (const Step& step : file.steps()) all.push_back(text(step.operation));
  return all;
}

class AmendedStep : public ::testing::Test {
 protected:
  AmendedStep() {
    std::string name = (std::filesystem::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "coat.karinui";
    file_ = *DocumentFile::create(path_);
    const Done played = room_.play(file_, std::string(kTwoPieces) +
                                              "move piece=front by=0,10cm,0\n"
                                              "cut piece=front line=\"0.2,-0.01 0.2,0.1\"\n"
                                              "sew a=front.side_left b=back.side_left\ndrape\n");
    EXPECT_TRUE(played);
  }
  ~AmendedStep() override { std::filesystem::remove_all(folder_); }
  void reopen() {
    file_ = DocumentFile::inMemory();
    auto opened = DocumentFile::open(path_);
    ASSERT_TRUE(opened) << text(opened.error().what);
    file_ = *std::move(opened);
  }

  std::filesystem::path folder_, path_;
  Workroom room_;
  DocumentFile file_ = DocumentFile::inMemory();
};

TEST_F(AmendedStep, PlaysWhatCameAfterItAgain) {
  const auto before = linesOf(file_);
  ASSERT_TRUE(file_.amend(4, *parseOperation("cut piece=p1 line=\"0.1,-0.01 0.1,0.2\""), room_.context));
  auto wanted = before;
  wanted[3] = "cut piece=p1 line=\"100mm,-10mm; 100mm,200mm\" name=front_2 corners=yes";
  EXPECT_EQ(linesOf(file_), wanted);
  // The same as if it had been done so from the beginning.
  DocumentFile fresh = DocumentFile::inMemory();
  std::string script;
  for (const std::string& line : wanted) script += line + "\n";
  ASSERT_TRUE(room_.play(fresh, script));
  EXPECT_EQ(hash(file_.document()), hash(fresh.document()));
  EXPECT_EQ(drapeHash(file_.document()), drapeHash(fresh.document()));
  reopen();
  EXPECT_EQ(linesOf(file_), wanted) << "and it is kept";
}

// What a drape depends on is the garment before it and the drape itself; come back to, it is not worked out again, and
// not after opening the file again either.
TEST_F(AmendedStep, WhatWasDrapedBeforeIsNotDrapedAgain) {
  int drapes = 0;
  Context counting = room_.context;
  counting.drape = [&](const Document& d, const DrapePieces& op, Context&) { return ++drapes, fallABit(d, op.live); };
  const std::string was = hash(file_.document()), stood = drapeHash(file_.document());
  const Operation there = file_.steps()[2].operation;
  ASSERT_TRUE(file_.amend(3, *parseOperation("move piece=p1 by=0,20cm,0"), counting));
  EXPECT_EQ(drapes, 1);
  EXPECT_NE(drapeHash(file_.document()), stood);
  const std::string elsewhere = drapeHash(file_.document());
  ASSERT_TRUE(file_.amend(3, there, counting));
  EXPECT_EQ(drapes, 1) << "it is known how it hung there";
  EXPECT_EQ(hash(file_.document()), was);
  EXPECT_EQ(drapeHash(file_.document()), stood);
  EXPECT_TRUE(file_.document().drape.dirty.empty());
  reopen();
  ASSERT_TRUE(file_.amend(3, *parseOperation("move piece=p1 by=0,20cm,0"), counting));
  EXPECT_EQ(drapes, 1);
  EXPECT_EQ(drapeHash(file_.document()), elsewhere);
  ASSERT_TRUE(file_.perform(*parseOperation("fabric name=denim piece=p1"), counting));
  ASSERT_TRUE(file_.perform(*parseOperation("drape"), counting));
  EXPECT_EQ(drapes, 2) << "another fabric hangs otherwise";
}

TEST_F(AmendedStep, WhatALaterStepCannotFollowChangesNothing) {
  const auto before = linesOf(file_);
  const std::string was = hash(file_.document());
  const Done done = file_.amend(
      1, *parseOperation("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; neck L 0 0\""), room_.context);
  ASSERT_FALSE(done);
  EXPECT_THAT(text(done.error().what), HasSubstr("Step 5:"));
  EXPECT_EQ(linesOf(file_), before);
  EXPECT_EQ(hash(file_.document()), was);
  EXPECT_TRUE(file_.otherBranches().empty());
  reopen();
  EXPECT_EQ(linesOf(file_), before);
}

TEST_F(AmendedStep, AStoppedReplayChangesNothing) {
  const auto before = linesOf(file_);
  Context stopping = room_.context;
  stopping.drape = [](const Document&, const DrapePieces&, Context&) -> Result<DrapeOutcome> { return cancelled(); };
  const Done done = file_.amend(3, *parseOperation("move piece=p1 by=0,20cm,0"), stopping);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, Error::Kind::Cancelled);
  EXPECT_EQ(linesOf(file_), before);
}

TEST_F(AmendedStep, TheWayItWasIsStillThere) {
  const auto before = linesOf(file_);
  const std::uint64_t old = file_.steps().back().seq;
  ASSERT_TRUE(file_.amend(3, *parseOperation("move piece=p1 by=0,20cm,0"), room_.context));
  const auto after = linesOf(file_);
  const auto ends = file_.otherBranches();
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends.front().seq, old);
  ASSERT_TRUE(file_.goTo(old, room_.context));
  EXPECT_EQ(linesOf(file_), before);
  ASSERT_TRUE(file_.goTo(file_.otherBranches().front().seq, room_.context));
  EXPECT_EQ(linesOf(file_), after);
}

TEST_F(AmendedStep, AStepOfThePresentWayCanBeReachedAndLeftAgain) {
  const auto steps = file_.steps();
  ASSERT_TRUE(file_.goTo(steps[1].seq, room_.context));
  EXPECT_EQ(file_.steps().size(), 2u);
  EXPECT_EQ(file_.undone().size(), 4u);
  ASSERT_TRUE(file_.goTo(0, room_.context));
  EXPECT_EQ(file_.undone().size(), 6u);
  reopen();
  ASSERT_TRUE(file_.goTo(steps.back().seq, room_.context));
  EXPECT_EQ(linesOf(file_).size(), 6u);
  const auto then = file_.documentAfter(steps[2].seq, room_.context);
  ASSERT_TRUE(then);
  EXPECT_EQ(hash(*then), steps[2].after);
  EXPECT_EQ(file_.steps().size(), 6u) << "looking goes nowhere";
}

// The inner edge of a ring is as long as its run of edges, whatever becomes of that.
TEST(AmendedSteps, ARingFollowsItsRun) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file,
                        "piece name=top outline=\"M 0 0; hem L 400 0; side L 400 300; up L 0 300; other L 0 0\"\n"
                        "ring name=peplum of=top.hem depth=18cm angle=150deg\n"));
  const auto inner = [&] { return findEdge(*file.document().pieceNamed("peplum"), "waist")->curve.length(); };
  EXPECT_NEAR(inner(), 0.4, 1e-6);
  ASSERT_TRUE(file.amend(
      1, op("piece name=top outline=\"M 0 0; hem L 520 0; side L 520 300; up L 0 300; other L 0 0\""), room.context));
  EXPECT_NEAR(inner(), 0.52, 1e-6);
}

}  // namespace
}  // namespace karinui
