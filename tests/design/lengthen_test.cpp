// An armhole is let out or deepened, and its cap goes with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/pattern/truing.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

struct Sleeved {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  explicit Sleeved(const std::string& more = {}) {
    room.context.advise = [this](const Advice& one) { said += text(one.what) + "\n"; };
    play("body size=eu38\nblock kind=shirt\n" + more);
  }
  void play(const std::string& script) {
    const Done done = room.play(file, script);
    ASSERT_TRUE(done) << text(done.error().what);
  }
  std::string refusal(const std::string& script) {
    const Done done = room.play(file, script);
    return done ? "" : text(done.error().what);
  }
  double length(const char* piece, const char* edge) {
    const Outline& outline = file.document().pieceNamed(piece)->outline;
    return outline.edges[*outline.find(edge)].curve.length();
  }
  double ease(const char* name) {
    for (const auto& [id, seam] : file.document().pattern.seams)
      if (seam.name == name) return lengthMismatch(file.document().pattern, seam);
    ADD_FAILURE() << name;
    return 0;
  }
  std::size_t faults() {
    const TruingReport report = truing(file.document().pattern, file.document().eases);
    std::size_t all = 0;
    for (const SeamTruing& seam : report.seams) all += !seam.fits();
    for (const CornerTruing& corner : report.corners) all += !corner.smooth();
    return all;
  }
};

constexpr const char* kDeeper = "lengthen edges=\"front_left.armhole back.armhole_left\" by=15mm\n";

TEST(Lengthen, AnArmholeGetsDeeperAndItsCapKeepsTheEase) {
  Sleeved shirt;
  const double front = shirt.length("front_left", "armhole"), back = shirt.length("back", "armhole_left");
  const double cap = shirt.length("sleeve_left", "cap_front") + shirt.length("sleeve_left", "cap_back");
  const double side = shirt.length("back", "side_left"), under = shirt.length("sleeve_left", "under_front");
  const double left = shirt.ease("armhole_left"), right = shirt.ease("armhole_right");
  const std::uint64_t steps = shirt.file.document().operations;
  shirt.said.clear();
  shirt.play(kDeeper);
  EXPECT_EQ(shirt.file.document().operations, steps + 1);
  EXPECT_NEAR(shirt.length("front_left", "armhole") + shirt.length("back", "armhole_left"), front + back + 0.015, 1e-6);
  EXPECT_NEAR(shirt.length("sleeve_left", "cap_front") + shirt.length("sleeve_left", "cap_back"), cap + 0.015, 1e-6);
  EXPECT_NEAR(shirt.ease("armhole_left"), left, 1e-6);
  EXPECT_NEAR(shirt.ease("armhole_right"), right, 1e-6) << "the other half of the garment, too";
  EXPECT_LT(shirt.length("back", "side_left"), side - 0.004) << "deeper down the side";
  EXPECT_NEAR(shirt.length("back", "side_left"), shirt.length("front_left", "side"), 1e-6);
  EXPECT_NEAR(shirt.length("sleeve_left", "under_front"), under, 1e-6);
  EXPECT_EQ(shirt.faults(), 0u);
  EXPECT_THAT(shirt.said, HasSubstr("as well"));
  EXPECT_THAT(shirt.said, testing::Not(HasSubstr("to which it is sewn")));
}

TEST(Lengthen, OutToTheSideTheSidesKeepTheirLength) {
  Sleeved shirt;
  const double side = shirt.length("back", "side_left"), ease = shirt.ease("armhole_left");
  const double hem = shirt.file.document().pieceNamed("back")->outline.area();
  shirt.play("lengthen edges=\"front_left.armhole back.armhole_left\" by=15mm beside=keep\n");
  EXPECT_NEAR(shirt.length("back", "side_left"), side, 1e-6);
  EXPECT_NEAR(shirt.length("front_left", "side"), side, 1e-6);
  EXPECT_NEAR(shirt.ease("armhole_left"), ease, 1e-6);
  EXPECT_GT(shirt.file.document().pieceNamed("back")->outline.area(), hem);
}

TEST(Lengthen, TheArmholeFollowsItsCap) {
  Sleeved shirt;
  const double ease = shirt.ease("armhole_left");
  const double armhole = shirt.length("front_left", "armhole") + shirt.length("back", "armhole_left");
  shirt.play("lengthen edges=sleeve_left.cap* by=-1cm beside=keep\n");
  EXPECT_NEAR(shirt.ease("armhole_left"), ease, 1e-6);
  EXPECT_NEAR(shirt.length("front_left", "armhole") + shirt.length("back", "armhole_left"), armhole - 0.01, 1e-6);
}

TEST(Lengthen, ALiningGoesWithItsCloth) {
  Sleeved shirt(
      "lining piece=\"front_left back front_right sleeve_left sleeve_right\" open=\"front_left.hem front_right.hem "
      "back.hem* sleeve_left.hem sleeve_right.hem\"\n");
  const auto eases = [&] {
    std::map<SeamId, double> all;
    for (const auto& [id, seam] : shirt.file.document().pattern.seams)
      all[id] = lengthMismatch(shirt.file.document().pattern, seam);
    return all;
  };
  const auto before = eases();
  shirt.play(kDeeper);
  for (const auto& [id, ease] : eases()) EXPECT_NEAR(ease, before.at(id), 6e-4) << text(id);
}

TEST(Lengthen, TheRestOfTheArmholeStays) {
  Sleeved shirt;
  const double back = shirt.length("back", "armhole_left"), ease = shirt.ease("armhole_left");
  shirt.play("lengthen edges=front_left.armhole by=1cm beside=keep\n");
  EXPECT_EQ(shirt.length("back", "armhole_left"), back);
  EXPECT_NEAR(shirt.ease("armhole_left"), ease, 1e-6);
}

TEST(Lengthen, TheCapStaysWhereThatIsAsked) {
  Sleeved shirt;
  const double cap = shirt.length("sleeve_left", "cap_front");
  shirt.said.clear();
  shirt.play("lengthen edges=\"front_left.armhole back.armhole_left\" by=15mm partners=no\n");
  EXPECT_EQ(shirt.length("sleeve_left", "cap_front"), cap);
  EXPECT_THAT(shirt.said, HasSubstr("to which it is sewn"));
}

TEST(Lengthen, TheImageOfAnEdgeIsNoSecondOne) {
  Sleeved one, both;
  one.play(kDeeper);
  both.play("lengthen edges=\"front_left.armhole front_right.armhole back.armhole_left back.armhole_right\" by=15mm\n");
  EXPECT_NEAR(one.length("front_left", "armhole"), both.length("front_left", "armhole"), 1e-9);
}

TEST(Lengthen, RefusesWhatCannotBe) {
  Sleeved shirt;
  EXPECT_THAT(shirt.refusal("lengthen edges=front_left.armhole by=0mm\n"), HasSubstr("not by 0.0 mm"));
  EXPECT_THAT(shirt.refusal("lengthen edges=collar.end_left by=-5cm\n"), HasSubstr("cannot become 50.0 mm shorter"));
  EXPECT_THAT(shirt.refusal("lengthen edges=\"front_left.armhole back.armhole_left\" by=90cm\n"),
              HasSubstr("beside=keep"));
  // A hem stands square to the sides: along them it would have to go ten centimetres.
  EXPECT_THAT(shirt.refusal("lengthen edges=back.hem_left by=25mm\n"), HasSubstr("nearly square to the run"));
  EXPECT_EQ(shirt.refusal("lengthen edges=back.hem_left by=25mm beside=keep\n"), "");
}

// A waist goes all round and has no end: it grows at the side seams, not at its darts nor in the middle, and so does
// the waistband, by what was asked for and not by that twice.
TEST(Lengthen, AWaistIsLetOutAtItsSideSeamsWithItsBand) {
  constexpr const char* kWaist =
      "skirt_front.waist_left skirt_front.waist_left_2 skirt_front.waist_right skirt_front.waist_right_2 "
      "skirt_back.waist_right skirt_back.waist_right_2 skirt_back.waist_left skirt_back.waist_left_2";
  for (const bool byBand : {false, true}) {
    Sleeved skirt(std::string("remove piece=\"front_left front_right back sleeve_left sleeve_right collar\"\n") +
                  "block kind=skirt\nband name=waistband depth=4cm sew=yes of=\"" + kWaist + "\"\n");
    const double low = skirt.length("waistband", "low"), top = skirt.length("waistband", "top");
    const double side = skirt.length("skirt_front", "side_left"), dart = skirt.length("skirt_front", "dart");
    const double atSide = skirt.length("skirt_front", "waist_left"),
                 atMiddle = skirt.length("skirt_front", "waist_left_2");
    const std::size_t faults = skirt.faults();
    skirt.said.clear();
    skirt.play(std::string("lengthen by=2cm beside=keep edges=\"") + (byBand ? "waistband.low" : kWaist) + "\"\n");
    EXPECT_NEAR(skirt.length("waistband", "low"), low + 0.02, 1e-5);
    EXPECT_NEAR(skirt.length("waistband", "top"), top + 0.02, 1e-3);
    EXPECT_NEAR(skirt.length("skirt_front", "waist_left"), atSide + 0.005, 5e-4);
    EXPECT_NEAR(skirt.length("skirt_front", "waist_left_2"), atMiddle, 1e-6);
    EXPECT_NEAR(skirt.length("skirt_front", "dart"), dart, 1e-6);
    EXPECT_NEAR(skirt.length("skirt_front", "side_left"), side, 1e-4);
    EXPECT_EQ(skirt.faults(), faults) << skirt.said;
    EXPECT_THAT(skirt.said, HasSubstr(byBand ? "lower edge of waistband: " : "lower edge of waistband as well: "));
  }
}

}  // namespace
}  // namespace karinui
