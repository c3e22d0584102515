// Notches of two edges that are sewn to each other meet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/pattern/markings.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// A front of both halves whose side is longer than the back's; a band on both of their waists, and its facing.
constexpr const char* kSewnPaper =
    "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 200 420; waist L -200 420; side_right L -200 0\"\n"
    "piece name=back pose=\"0,0,-0.3 y 180deg\" outline=\"M -200 0; hem L 200 0; side_right L 200 400; waist L -200 "
    "400; "
    "side_left L -200 0\"\n"
    "piece name=band outline=\"M 0 600; low L 800 600; end L 800 650; top L 0 650; start L 0 600\"\n"
    "piece name=facing outline=\"M 0 700; low L 800 700; end L 800 750; top L 0 750; start L 0 700\"\n"
    "sew a=front.side_left b=back.side_left name=left\nsew a=front.side_right b=back.side_right name=right\n"
    "sew a=\"front.waist back.waist\" b=band.low name=waist\nsew a=band.top b=facing.top reversed=no name=top\n";

struct Notched {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string play(const std::string& script) {
    const Done done = room.play(file, script);
    return done ? "" : text(done.error().what);
  }
  // "side_left@0.25 …", in their order.
  std::string on(const char* piece) const {
    std::string all;
    for (const Mark& mark : file.document().pieceNamed(piece)->marks) {
      char words[80];
      std::snprintf(words, sizeof words, "%s@%.3f", mark.edge.c_str(), mark.fraction);
      all += (all.empty() ? "" : " ") + std::string(words);
    }
    return all;
  }
};

TEST(Notches, MeetOnTheEdgeThatIsSewnTo) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.25 symmetric=yes\n"), "");
  EXPECT_EQ(t.on("front"), "side_left@0.250 side_right@0.750");
  EXPECT_EQ(t.on("back"), "side_left@0.750 side_right@0.250") << "the same share of the shorter side";
  EXPECT_EQ(std::get<AddNotch>(t.file.steps().back().operation).partners, Choice::Yes) << "recorded as decided";
  // Both are the person's own, on the table and on the paper alike.
  int own = 0;
  for (const NotchPlace& place : notchPlaces(t.file.document().pattern)) own += place.own;
  EXPECT_EQ(own, 4);
  ASSERT_TRUE(t.file.undo(t.room.context));
  EXPECT_EQ(t.on("front") + t.on("back"), "") << "one undo takes all of it back";
}

TEST(Notches, GoThroughOneSeamToTheNext) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=front.waist at=0.25 name=pleat\n"), "");
  const std::string band = t.on("band");
  EXPECT_THAT(band, HasSubstr("low@"));
  EXPECT_EQ(t.on("facing"), "") << "the band's other edge has none";
  EXPECT_EQ(t.on("back"), "");
  EXPECT_EQ(t.file.document().pieceNamed("band")->marks.front().name, "pleat");
  ASSERT_EQ(t.play("notch edge=band.top at=0.4\n"), "");
  EXPECT_EQ(t.on("facing"), "top@0.400");
}

TEST(Notches, AreTakenAwayTogether) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.25\nnotch edge=front.side_left at=0.5\n"), "");
  ASSERT_EQ(t.on("back"), "side_left@0.750 side_left@0.500");
  ASSERT_EQ(t.play("erase piece=back at=\"-20cm,20cm\"\n"), "") << "the middle of the side";
  EXPECT_EQ(t.on("front"), "side_left@0.250");
  EXPECT_EQ(t.on("back"), "side_left@0.750");
  ASSERT_EQ(t.play("erase piece=back at=\"-20cm,10cm\" partners=no\n"), "");
  EXPECT_EQ(t.on("front"), "side_left@0.250") << "that of one piece alone";
  EXPECT_EQ(t.on("back"), "");
}

TEST(Notches, OneThatIsThereIsNotDoubled) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=back.side_left at=0.75 partners=no\n"), "");
  EXPECT_EQ(t.on("front"), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.25\n"), "");
  EXPECT_EQ(t.on("back"), "side_left@0.750");
}

TEST(Notches, OfAnEdgeThatIsFreeNothingIsRecorded) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=front.hem at=0.25\n"), "");
  EXPECT_EQ(std::get<AddNotch>(t.file.steps().back().operation).partners, Choice::Auto);
  EXPECT_THAT(t.play("notch edge=front.hem at=0.75 partners=yes\n"), HasSubstr("Nothing is sewn"));
}

// A step of a program that did not know of partners stays what it was, also when steps are played again.
TEST(Notches, StepsOfOldStayAlone) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.25\n"), "");
  Operation old = t.file.steps().back().operation;
  std::get<AddNotch>(old).partners = Choice::Auto;
  EXPECT_EQ(std::get<AddNotch>(asRecorded(old)).partners, Choice::No);
  ASSERT_TRUE(t.file.undo(t.room.context));
  Context again = t.room.context;
  again.recorded = true;
  const auto after = apply(t.file.document(), old, again);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->pieceNamed("front")->marks.size(), 1u);
  EXPECT_TRUE(after->pieceNamed("back")->marks.empty());
}

// Beside a zip nothing is sewn, and yet both sides are to meet when it is closed.
TEST(Notches, MeetOverAZip) {
  Notched t;
  ASSERT_EQ(t.play(kSewnPaper), "");
  ASSERT_EQ(t.play("fasten kind=zip a=front.side_left b=back.side_left length=18cm\n"), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.75\n"), "");
  EXPECT_EQ(t.on("front"), "side_left@0.750");
  EXPECT_EQ(t.on("back"), "side_left@0.250");
  EXPECT_EQ(std::get<AddNotch>(t.file.steps().back().operation).zips, Choice::Yes) << "recorded as decided";
  ASSERT_EQ(t.play("erase piece=back at=\"-200mm,300mm\"\n"), "");
  EXPECT_EQ(t.on("front") + t.on("back"), "") << "both go";
  ASSERT_EQ(t.play("fasten name=zip closed_length=0\nnotch edge=front.side_left at=0.75 zips=no\n"), "");
  EXPECT_EQ(t.on("back"), "");
  ASSERT_EQ(t.play("notch edge=front.side_left at=0.8\n"), "");
  EXPECT_EQ(t.on("back"), "side_left@0.200") << "open, too";
}

}  // namespace
}  // namespace karinui
