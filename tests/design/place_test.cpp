// A piece wrapped round a limb stands off that limb alone, not off the trunk beside it.
#include <gtest/gtest.h>

#include <algorithm>

#include "design/workroom.h"

namespace karinui {
namespace {

class Placed : public ::testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figure is built once
    return shared;
  }
  // A rectangle of this width and length (millimetres), placed with a centimetre of ease: how far its points are from
  // the skin, ordered.
  std::vector<double> gaps(const std::string& width, const std::string& tall, const std::string& at) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, "body size=jis9ar\npiece name=tube outline=\"M 0 0; hem L " + width +
                                            " 0; a L " + width + " " + tall + "; top L 0 " + tall +
                                            "; b L 0 0\"\nplace piece=tube at=\"" + at + "\" ease=12mm\n");
    EXPECT_TRUE(done) << text(done.error().what);
    std::vector<double> out;
    if (!done) return out;
    const auto body = bodyOf(file.document(), room().context);
    const Piece& piece = *file.document().pieceNamed("tube");
    for (const Vec3 p : piece.form->space) out.push_back((*body)->bvh().signedDistance(p));
    std::sort(out.begin(), out.end());
    return out;
  }
};

TEST_F(Placed, ASleeveStandsOffTheUpperArm) {
  for (const char* at : {"left_arm:elbow-0.4@0.25", "right_arm:elbow-0.4@0.75"}) {
    const auto off = gaps("300", "150", at);
    ASSERT_FALSE(off.empty());
    EXPECT_GT(off.front(), 0.003) << at;          // nothing touches
    EXPECT_LT(off[off.size() / 2], 0.020) << at;  // most of it is near: the trunk has not widened it
    EXPECT_LT(off.back(), 0.040) << at;
  }
}

TEST_F(Placed, ASleeveUpToTheShoulderIsNotWidenedByTheTrunk) {
  for (const char* at : {"left_arm:armpit-0.2@0.25", "right_arm:armpit-0.4@0.75"}) {
    const auto off = gaps("340", "240", at);
    ASSERT_FALSE(off.empty());
    EXPECT_LT(off[off.size() / 2], 0.025) << at;
    EXPECT_LT(off.back(), 0.06) << at;
  }
}

TEST_F(Placed, ALegOfTrousersStandsOffTheThighAndOffTheCalf) {
  for (const auto& [at, width] : {std::pair{"left_leg:knee-0.5@0.25", "520"}, {"right_leg:knee+0.4@0.5", "380"}}) {
    const auto off = gaps(width, "120", at);
    ASSERT_FALSE(off.empty());
    EXPECT_GT(off.front(), 0.004) << at;
    EXPECT_LT(off[off.size() / 2], 0.020) << at;
  }
}

TEST_F(Placed, ABandGoesRoundTheWaist) {
  const auto off = gaps("700", "40", "torso:waist@0.1");
  ASSERT_FALSE(off.empty());
  EXPECT_GT(off.front(), 0.004);
  EXPECT_LT(off[off.size() / 2], 0.025);
}

}  // namespace
}  // namespace karinui
