// Garments next to each other, whole turns, and everyone of a batch, as pictures of the command.
#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

#include "apps/command.h"
#include "soak.h"
#include "view/kept_picture.h"

namespace karinui::test {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

// A tube round the hips, coarsely laid and graded: quick to settle.
const char* const kTube =
    "body size=eu38\nset spacing=50mm\npiece name=tube outline=\"M 0 0; hem L 1100 0; right L 1100 300; waist L 0 300; "
    "left L 0 0\"\nplace piece=tube at=\"torso:hip@0\" ease=3cm\nsew a=tube.left b=tube.right\npin edge=tube.waist\n";
const char* const kGraded = "grade sizes=\"S M L\" base=M\ngrade corners=\"tube.right tube.waist\" by=4cm,0\n";

class SideBySide : public testing::Test {
 protected:
  Folder folder;
  std::string made(const std::string& name, const std::string& script) {
    write(folder / (name + ".ops"), script);
    const Said said = karinui("play " + (folder / (name + ".ops")) + " -o " + (folder / (name + ".karinui")));
    EXPECT_EQ(said.exit, 0) << said.err;
    return folder / (name + ".karinui");
  }
  Said picture(const std::string& words) {
    return karinui("picture " + words + " --json --size 60x100 -o " + (folder / "p.png"));
  }
  std::string png() const { return contents(folder / "p.png"); }
};

TEST_F(SideBySide, DocumentsSizesAndFabricsStandInOneRow) {
  const std::string tube = made("tube", std::string(kTube) + kGraded + "drape\n"), plain = made("plain", kTube);
  const auto hash = karinui("info " + tube + " --json").json()["hash"];
  const Said two = picture(tube + " --beside " + plain);
  ASSERT_EQ(two.exit, 0) << two.err;
  EXPECT_THAT(two.err, HasSubstr("“plain”: not draped yet; it is drawn as it stands."));
  EXPECT_EQ(two.err.find("“tube”"), std::string::npos) << two.err;
  const int one = 60, margins = 8;
  EXPECT_EQ(two.json()["width"], 2 * one + margins);
  const std::string pair = png();
  const Said sizes = picture(tube + " --sizes");
  ASSERT_EQ(sizes.exit, 0) << sizes.err;
  EXPECT_EQ(sizes.json()["width"], 3 * one + margins);
  EXPECT_NE(pair, png());
  const Said fabrics = picture(tube + " --fabrics \"cotton silk, denim jersey\" --map strain --view oblique");
  ASSERT_EQ(fabrics.exit, 0) << fabrics.err;
  EXPECT_EQ(fabrics.json()["width"], 4 * one + margins);
  EXPECT_EQ(karinui("info " + tube + " --json").json()["hash"], hash) << "the document is left as it is";
  // How hard it presses: on the bared body, and of nothing that was not draped.
  ASSERT_EQ(picture(tube).exit, 0);
  const std::string bare = png();
  const Said pressed = picture(tube + " --map pressure");
  ASSERT_EQ(pressed.exit, 0) << pressed.err;
  EXPECT_NE(png(), bare);
  EXPECT_EQ(picture(tube + " --fabrics \"cotton silk\" --map pressure").exit, 0);
  const Said hanging = picture(tube + " --beside " + plain + " --map pressure");
  EXPECT_EQ(hanging.exit, 3);
  EXPECT_THAT(hanging.err, HasSubstr("“plain”: There is no pressure to show yet"));
  const Said turned = picture(tube + " --beside " + plain + " --turns 5");
  ASSERT_EQ(turned.exit, 0) << turned.err;
  EXPECT_EQ(turned.json()["width"], 5 * one + margins);
  EXPECT_GT(turned.json()["height"].get<int>(), 2 * 100);
}

// Each figure of a row wears what it is said to wear: two alike are drawn alike, in another fabric it is another
// picture.
TEST_F(SideBySide, EachFigureOfARowOfFabricsIsMadeInItsOwn) {
  const std::string tube = made("tube", std::string(kTube) + "drape\n");
  const auto row = [&](const std::string& fabrics) {
    const Said said = picture(tube + " --fabrics \"" + fabrics + "\"");
    EXPECT_EQ(said.exit, 0) << said.err;
    return readPng(folder / "p.png");
  };
  // Places at which the figure of a column differs between two rows; what is written below it is left out.
  constexpr int kWide = 60, kHigh = 100, kMargin = 4, kOther = 40;
  const Image alike = row("cotton cotton"), mixed = row("cotton denim");
  const auto unlike = [&](int column) {
    int count = 0;
    for (int y = kMargin; y < kMargin + kHigh; ++y)
      for (int x = kMargin + column * kWide; x < kMargin + (column + 1) * kWide; ++x) {
        const Pixel one = alike.at(x, y), other = mixed.at(x, y);
        int away = 0;
        for (std::size_t c = 0; c < 3; ++c) away += std::abs(one[c] - other[c]);
        count += away > kOther;
      }
    return count;
  };
  EXPECT_LT(unlike(0), 20);
  EXPECT_GT(unlike(1), 150);
}

TEST_F(SideBySide, SaysWhatCannotBe) {
  const std::string tube = made("tube", kTube);
  const std::string bare = made("bare", "piece name=a outline=\"M 0 0; e L 100 0; f L 100 100; g L 0 0\"\n");
  const auto refused = [&](const std::string& words, int exit = 3) {
    fs::remove(folder / "p.png");
    const Said said = picture(words);
    EXPECT_EQ(said.exit, exit) << words << said.err;
    EXPECT_FALSE(fs::exists(folder / "p.png"));
    return said.err;
  };
  EXPECT_THAT(refused(tube + " --beside " + bare), HasSubstr("“bare” has no figure"));
  EXPECT_THAT(refused(tube + " --beside " + (folder / "none.karinui")), HasSubstr("none.karinui"));
  EXPECT_THAT(refused(tube + " --sizes"), HasSubstr("made in one size"));
  EXPECT_THAT(refused(tube + " --fabrics \"cotton tweeed\""), HasSubstr("tweeed"));
  EXPECT_THAT(refused(tube + " --fabrics cotton --beside " + tube), HasSubstr("say one of"));
  EXPECT_THAT(refused(tube + " --turns 4 --eyes anaglyph", 2), HasSubstr("one eye"));
  EXPECT_THAT(refused(tube + " --turns 4 --frames 4", 2), HasSubstr("together"));
  EXPECT_THAT(refused(tube + " --turns 1", 2), HasSubstr("turns"));
  EXPECT_THAT(refused(tube + " --table --beside " + tube, 2), HasSubstr("together"));
  std::string many = tube + " --beside";
  for (int k = 0; k < 24; ++k) many += " " + tube;
  EXPECT_THAT(refused(many), HasSubstr("25 garments are too many"));
}

TEST_F(SideBySide, AWholeTurnIsNumberedPicturesWithEvenSides) {
  const std::string tube = made("tube", kTube);
  const std::string film = folder / "film";
  const std::string words = "picture " + tube + " --size 61x99 --json --frames ";
  const Said lone = karinui(words + "3 -o " + film);
  ASSERT_EQ(lone.exit, 0) << lone.err;
  EXPECT_EQ(lone.json()["frames"], 3);
  EXPECT_EQ(lone.json()["width"], 62);
  EXPECT_EQ(lone.json()["height"], 100);
  std::set<std::string> pictures;
  for (const char* name : {"frame_0001.png", "frame_0002.png", "frame_0003.png"}) {
    EXPECT_TRUE(fs::exists(film + "/" + name)) << name;
    pictures.insert(contents(film + "/" + name));
  }
  EXPECT_EQ(pictures.size(), 3u) << "each from another side";
  EXPECT_EQ(std::distance(fs::directory_iterator(film), {}), 3);
  const Said again = karinui(words + "2 -o " + film);
  EXPECT_EQ(again.exit, 3);
  EXPECT_THAT(again.err, HasSubstr("is not empty"));
  EXPECT_EQ(std::distance(fs::directory_iterator(film), {}), 3) << "nothing is mixed into another film";
  const Said two = karinui(words + "2 --fabrics 'cotton silk' -o " + (folder / "two"));
  ASSERT_EQ(two.exit, 0) << two.err;
  EXPECT_EQ(two.json()["width"].get<int>() % 2, 0);
  EXPECT_EQ(two.json()["height"].get<int>() % 2, 0);
  EXPECT_GT(two.json()["width"].get<int>(), 122);
}

TEST_F(SideBySide, EveryoneOfABatchAndWhomItDoesNotFit) {
  if (!atLength()) GTEST_SKIP() << "only by ./test --long";
  made("tube", kTube);
  write(folder / "people.csv",
        "name,sex,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nAnna,f,168,88,70,96\nBerta,f,165,112,104,124\n"
        "Clara,f,160,84,66,92\ngiant,f,400,88,70,96\n");
  const std::string run = folder / "run", out = " --json --size 60x100 -o " + (folder / "p.png");
  ASSERT_EQ(karinui("batch plan " + (folder / "tube.ops") + " " + (folder / "people.csv") + " -o " + run).exit, 0);
  const Said early = karinui("batch picture " + run + out);
  EXPECT_EQ(early.exit, 3);
  EXPECT_THAT(early.err, HasSubstr("Nothing of this batch is done yet"));
  ASSERT_EQ(karinui("batch run " + run).exit, 0);
  const Said all = karinui("batch picture " + run + out);
  ASSERT_EQ(all.exit, 0) << all.err;
  EXPECT_EQ(all.json()["garments"], 4);
  EXPECT_EQ(all.json()["misfits"], 2) << "Berta is wider than the tube, and nobody is four metres high";
  EXPECT_EQ(all.json()["width"], 4 * 60 + 8);
  const std::string first = png();
  EXPECT_EQ(karinui("batch picture " + run + out).json()["misfits"], 2);
  EXPECT_EQ(png(), first) << "from the garments that were kept";
  const Said misfits = karinui("batch picture " + run + " --misfits" + out);
  EXPECT_EQ(misfits.json()["garments"], 2) << misfits.err;
  const Said chosen = karinui("batch picture " + run + " --person Anna Clara --map strain --view back" + out);
  EXPECT_EQ(chosen.json()["garments"], 2) << chosen.err;
  EXPECT_EQ(chosen.json()["misfits"], 0);
  EXPECT_EQ(karinui("batch picture " + run + " --map pressure" + out).json()["garments"], 4);
  EXPECT_THAT(karinui("batch picture " + run + " --misfits --person Anna" + out).err,
              HasSubstr("fits everyone who was asked for; leave out --misfits"));
  EXPECT_THAT(karinui("batch picture " + run + " --person Dora" + out).err, HasSubstr("no person “Dora”"));
  EXPECT_THAT(karinui("batch picture " + run + " --design coat" + out).err, HasSubstr("no design “coat”"));
  EXPECT_EQ(karinui("batch picture " + run + " --view inside" + out).exit, 2);
  // What was kept is a document like any other, at rest as its outcome says.
  std::size_t kept = 0;
  for (const auto& entry : fs::directory_iterator(run + "/garments")) {
    ++kept;
    const auto outcome = nlohmann::json::parse(contents(run + "/items/" + entry.path().stem().string() + ".json"));
    EXPECT_EQ(karinui("info " + entry.path().string() + " --json").json()["hash"], outcome["numbers"]["hash"]);
  }
  EXPECT_EQ(kept, 3u) << "no half document of the one that was refused";
}

}  // namespace
}  // namespace karinui::test
