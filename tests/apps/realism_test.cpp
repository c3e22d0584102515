// Garments whose drape was once not to be believed, as pictures against kept ones: docs/develop/realism.md tells each.
#include "apps/command.h"
#include "view/easel.h"
#include "view/kept_picture.h"

namespace karinui::test {
namespace {

class Realism : public Easel {
 protected:
  struct Part {
    int left, top, width, height;
  };
  // The garment of realism/NAME.ops, draped, seen obliquely at 1100 x 1400 pixels; a part of that.
  static void expectAsKept(const std::string& name, Part part) {
    const Folder folder;
    const std::string document = folder / (name + ".karinui"), picture = folder / "whole.png";
    ASSERT_EQ(karinui("play '" KARINUI_SOURCE "/tests/apps/realism/" + name + ".ops' -o " + document).exit, 0);
    const Said rested = karinui("settle " + document + " --json");
    ASSERT_EQ(rested.exit, 0) << rested.err;
    const nlohmann::json found = rested.json();
    EXPECT_TRUE(found["settled"]);
    EXPECT_EQ(found["cloth_body_crossings"], 0);
    EXPECT_EQ(found["cloth_cloth_crossings"], 0);
    EXPECT_EQ(found["fold_crossings"], 0);
    ASSERT_EQ(karinui("picture " + document + " --view oblique --size 1100x1400 -o " + picture).exit, 0);
    const Image whole = readPng(picture);
    ASSERT_EQ(whole.width, 1100);
    Image cut(part.width, part.height);
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) cut.set(x, y, whole.at(part.left + x, part.top + y));
    expectKept(KARINUI_SOURCE "/docs/develop/realism/" + name + ".png", cut);
  }
};

class RealismAtLength : public Realism {
  void SetUp() override {
    if (const char* asked = std::getenv("KARINUI_LONG"); !asked || !*asked) GTEST_SKIP() << "only by ./test --long";
    Realism::SetUp();
  }
};

TEST_F(Realism, SideSeamsRunSmoothlyUnderTheArm) { expectAsKept("underarm", {560, 310, 300, 380}); }
TEST_F(Realism, ATightTubeStaysOnTheHips) { expectAsKept("tight_tube", {380, 260, 330, 560}); }
TEST_F(RealismAtLength, AWideNeckLiesOnTheShoulders) { expectAsKept("wide_neck", {440, 150, 390, 420}); }
TEST_F(RealismAtLength, AStandCollarStands) { expectAsKept("collar", {385, 130, 420, 400}); }
TEST_F(RealismAtLength, HemsOfACircleSkirtHang) { expectAsKept("circle_skirt", {330, 560, 480, 460}); }
TEST_F(RealismAtLength, SixSkirtsHangFromTheWaist) { expectAsKept("six_layers", {330, 320, 480, 760}); }

}  // namespace
}  // namespace karinui::test
