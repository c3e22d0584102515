// The lay plan, a garment made to another body, and its report, by the command.
#include <gmock/gmock.h>

#include "command.h"

namespace karinui::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string skirt(const Folder& folder) {
  const std::string document = folder / "skirt.karinui";
  write(folder / "skirt.ops",
        "piece name=front outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; fold L 0 0\"\n"
        "piece name=back outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; cb L 0 0\" pose=\"0,0,-0.3\"\n"
        "quantity piece=back count=2 pairs=yes\n");
  EXPECT_EQ(karinui("play " + (folder / "skirt.ops") + " -o " + document).exit, 0);
  return document;
}

TEST(Layout, IsDrawnAtTrueSizeInEveryFormat) {
  const Folder folder;
  const std::string document = skirt(folder), words = "layout " + document + " --tries 80 --width 140cm -o ";
  const auto told = karinui(words + (folder / "a.pdf") + " --json").json();
  const double length = told["fabrics"][0]["length_m"];
  EXPECT_GT(told["fabrics"][0]["use"].get<double>(), 0.5);
  EXPECT_EQ(told["fabrics"][0]["pieces"], 3);
  EXPECT_THAT(contents(folder / "a.pdf"), StartsWith("%PDF"));
  ASSERT_EQ(karinui(words + (folder / "a.svg")).exit, 0);
  const std::string svg = contents(folder / "a.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"1440mm\""));  // the cloth and 20 mm on either side
  EXPECT_THAT(svg, HasSubstr("class=\"cloth\""));
  ASSERT_EQ(karinui(words + (folder / "a.dxf")).exit, 0);
  // The cloth's corners stand 1400 mm apart, and as long as was told.
  const std::string dxf = contents(folder / "a.dxf");
  EXPECT_THAT(dxf, HasSubstr("\r\n1420.0000\r\n"));
  ASSERT_EQ(karinui(words + (folder / "a.plt")).exit, 0);
  const std::string plt = contents(folder / "a.plt");
  EXPECT_THAT(plt, StartsWith("IN;"));
  // 40 units a millimetre: from 20 mm across to 1420 mm.
  EXPECT_THAT(plt, HasSubstr("," + std::to_string(1420 * 40)));
  const long end = std::lround((length * 1000 + 180) * 40);
  EXPECT_TRUE(plt.find(std::to_string(end) + ",800") != std::string::npos) << end;
  EXPECT_EQ(karinui(words + (folder / "a.png")).exit, 3);
  EXPECT_EQ(karinui("layout " + document + " --width 3stones").exit, 2);
  const Said japanese = karinui("layout " + document + " --tries 8 --fold", "ja_JP.UTF-8");
  EXPECT_THAT(japanese.out, HasSubstr("縦に二つ折り"));
}

TEST(Refit, MakesAgainWhatTheFigureMade) {
  const Folder folder;
  write(folder / "a.ops",
        "body size=jis9ar\nblock kind=skirt\n"
        "piece name=patch outline=\"M 0 0; low L 150 0; side L 150 180; top L 0 180; in L 0 0\" pose=\"0,1,0.4\"\n");
  ASSERT_EQ(karinui("play " + (folder / "a.ops") + " -o " + (folder / "a.karinui")).exit, 0);
  write(folder / "b.measures",
        "sex = female\nbust_girth = 100cm\nwaist_girth = 84cm\nhip_girth = 108cm\nheight = 170cm\n");
  const Said said = karinui("refit " + (folder / "a.karinui") + " --body " + (folder / "b.measures") + " -o " +
                            (folder / "b.karinui"));
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("“patch” keeps its drafted size, 150 × 180 mm"));
  const auto json = karinui("refit " + (folder / "a.karinui") + " --body " + (folder / "b.measures") + " -o " +
                            (folder / "b.karinui") + " --overwrite --json")
                        .json();
  int larger = 0;
  for (const auto& piece : json["fitted"]) {
    EXPECT_EQ(piece["kept"], piece["piece"] == "patch");
    larger += !piece["kept"] && piece["across_mm"] > piece["was_across_mm"];
  }
  EXPECT_GE(larger, 2);
  // On the body it was made on nothing changes.
  const auto same =
      karinui("refit " + (folder / "a.karinui") + " --body jis9ar -o " + (folder / "c.karinui") + " --json").json();
  for (const auto& piece : same["fitted"]) EXPECT_EQ(piece["kept"], true);
  EXPECT_EQ(same["hash"], karinui("info " + (folder / "a.karinui") + " --json").json()["hash"]);
}

// A straight skirt in five sizes, 4 cm round the waist and hips between each: on the body it was made on it has an
// ease, and the size with that ease on the other body is nearest.
TEST(Refit, TellsTheNearestSize) {
  const Folder folder;
  write(folder / "a.ops",
        "body set=\"height = 168cm; bust_girth = 88cm; waist_girth = 72cm; hip_girth = 96cm\"\n"
        "piece name=front outline=\"M 0 0; hem L 500 0; side L 500 400; hip L 380 600; waist L 120 600; other L 0 400; "
        "low L 0 0\"\n"
        "piece name=back outline=\"M 0 0; hem L 500 0; side L 500 400; hip L 380 600; waist L 120 600; other L 0 400; "
        "low L 0 0\" pose=\"0,0,-0.3\"\n"
        "grade sizes=\"36 38 40 42 44\" base=38\n"
        "grade corners=\"front.side front.hip front.waist back.side back.hip back.waist\" by=2cm,0 symmetric=no\n");
  const Said played = karinui("play " + (folder / "a.ops") + " -o " + (folder / "a.karinui"));
  ASSERT_EQ(played.exit, 0) << played.err;
  write(folder / "b.measures",
        "sex = female\nheight = 168cm\nbust_girth = 97cm\nwaist_girth = 81cm\nhip_girth = 105cm\n");
  const std::string words =
      "refit " + (folder / "a.karinui") + " --body " + (folder / "b.measures") + " -o " + (folder / "b.karinui");
  const Said said = karinui(words);
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("Of its sizes 42 is nearest to this body; 38 stands."));
  const auto json = karinui(words + " --overwrite --json").json()["sizes"];
  EXPECT_EQ(json["nearest"], "42");
  EXPECT_EQ(json["ease_known"], true);
  // 8 cm more where the body has 9 more.
  ASSERT_GE(json["girths"].size(), 1u);
  for (const auto& girth : json["girths"]) EXPECT_NEAR(girth["miss_mm"].get<double>(), -10, 6) << girth;
  // The very body: the size that stands, without a miss.
  write(folder / "c.ops", contents(folder / "a.ops").substr(contents(folder / "a.ops").find('\n') + 1));
  ASSERT_EQ(karinui("play " + (folder / "c.ops") + " -o " + (folder / "c.karinui")).exit, 0);
  const Said bare = karinui("refit " + (folder / "c.karinui") + " --body " + (folder / "b.measures") + " -o " +
                            (folder / "d.karinui"));
  EXPECT_THAT(bare.out, HasSubstr("made on no figure"));
  // A file of the trade tells no ease either; whoever says which size stands is told nothing.
  ASSERT_EQ(karinui("export " + (folder / "c.karinui") + " -o " + (folder / "c.dxf") + " --allowance 0").exit, 0);
  const std::string import = "import " + (folder / "c.dxf") + " --body " + (folder / "b.measures") + " -o " +
                             (folder / "e.karinui") + " --overwrite";
  EXPECT_THAT(karinui(import).err, HasSubstr("is nearest to this body"));
  EXPECT_THAT(karinui(import + " --size 40").err, Not(HasSubstr("nearest")));
}

TEST(Refit, TellsTheStepThatCannotBeDone) {
  const Folder folder;
  write(folder / "a.ops", "body size=jis9ar\nrectangle name=tab width=\"waist_girth - 60cm\" height=4cm\n");
  const Said played = karinui("play " + (folder / "a.ops") + " -o " + (folder / "a.karinui"));
  ASSERT_EQ(played.exit, 0) << played.err;
  write(folder / "slim.measures",
        "sex = female\nheight = 158cm\nbust_girth = 78cm\nwaist_girth = 58cm\nhip_girth = 86cm\n");
  const Said said = karinui("refit " + (folder / "a.karinui") + " --body " + (folder / "slim.measures") + " -o " +
                            (folder / "b.karinui"));
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("Step 2, rectangle"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.karinui"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.karinui.part"));
}

TEST(Report, HasTheFiguresInBothLanguages) {
  const Folder folder;
  write(folder / "a.ops", "body size=jis9ar\nblock kind=skirt\n");
  ASSERT_EQ(karinui("play " + (folder / "a.ops") + " -o " + (folder / "a.karinui")).exit, 0);
  const Said english =
      karinui("report " + (folder / "a.karinui") + " -o " + (folder / "en.pdf") + " --no-pictures --language en");
  ASSERT_EQ(english.exit, 0) << english.err;
  ASSERT_EQ(
      karinui("report " + (folder / "a.karinui") + " -o " + (folder / "ja.pdf") + " --no-pictures --language ja").exit,
      0);
  const auto words = [&](const std::string& name) {
    if (std::system(("pdftotext -layout " + (folder / (name + ".pdf")) + " " + (folder / name)).c_str()) != 0)
      return std::string();
    return contents(folder / name);
  };
  if (std::system("command -v pdftotext >/dev/null") != 0) GTEST_SKIP() << "pdftotext is not installed";
  EXPECT_THAT(words("en"), HasSubstr("Waist girth"));
  EXPECT_THAT(words("en"), HasSubstr("Cloth to buy"));
  EXPECT_THAT(words("en"), HasSubstr("64.0 cm"));  // of the figure's waist
  EXPECT_THAT(words("ja"), HasSubstr("用布量"));
}

}  // namespace
}  // namespace karinui::test
