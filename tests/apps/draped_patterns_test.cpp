// Drafted patterns of other programs, from file to draped garment by two commands, on the body they were drafted for.
#include <set>

#include "command.h"

namespace karinui::test {
namespace {

struct Draft {
  std::string pattern, body;
  bool sewn = false;      // by the file itself
  bool onlyLong = false;  // in ./test --long
};

class DrapedPatterns : public testing::TestWithParam<Draft> {};

TEST_P(DrapedPatterns, RestOnTheirBodies) {
  const std::filesystem::path shared = KARINUI_SHARED_DIR;
  const std::filesystem::path pattern = shared / "patterns" / GetParam().pattern,
                              body = shared / "bodies" / (GetParam().body + ".obj");
  if (!std::filesystem::exists(pattern) || !std::filesystem::exists(body)) GTEST_SKIP() << "no shared patterns here";
  const char* asked = std::getenv("KARINUI_LONG");
  if (GetParam().onlyLong && !(asked && *asked)) GTEST_SKIP() << "./test --long";
  const Folder folder;
  const std::string document = folder / "garment.karinui";
  const Said read = karinui("import " + pattern.string() + " --body " + body.string() +
                            (GetParam().sewn ? "" : " --sew auto") + " -o " + document);
  ASSERT_EQ(read.exit, 0) << read.err;
  const auto rest = karinui("settle " + document + " --threads 1 --json").json();
  EXPECT_EQ(rest["settled"], true) << rest["why"];
  EXPECT_LE(rest["seam_gap_mm"].get<double>(), 0.001);
  const auto found = karinui("check " + document + " --json").json();
  EXPECT_EQ(found["penetration_mm"], 0);
  for (const char* crossings : {"cloth_body_crossings", "cloth_cloth_crossings", "fold_crossings"})
    EXPECT_EQ(found[crossings], 0) << crossings;
}

// What ./run shows first: drawn, sewn, pulled and slit, with a drape after each, and all of it at rest at the end.
TEST(Samples, TheKyotoFittingRests) {
  const Folder folder;
  const std::string document = folder / "kyoto.karinui";
  const Said played = karinui("play " KARINUI_SOURCE_DIR "/examples/kyoto_fitting.ops -o " + document);
  EXPECT_EQ(played.exit, 0) << played.err;
  const auto found = karinui("check " + document + " --json").json();
  EXPECT_EQ(found["at_rest"], true);
  EXPECT_EQ(found["penetration_mm"], 0);
  EXPECT_EQ(found["cloth_body_crossings"], 0);
  EXPECT_EQ(found["cloth_cloth_crossings"], 0);
}

// What a tailor cuts: sewn edges fit or their ease is declared, doubled pieces are cut twice. The paper needs no drape.
struct OnPaper {
  std::string name;
  int doubled = 0;  // pieces that are cut twice
  int corners = 0;  // that do not go on smoothly, because a design wants it so
};
class ExamplesOnPaper : public testing::TestWithParam<OnPaper> {};

TEST_P(ExamplesOnPaper, AreComplete) {
  const Folder folder;
  const std::string document = folder / "garment.karinui", script = folder / "garment.ops";
  std::istringstream lines(contents(KARINUI_SOURCE_DIR "/examples/" + GetParam().name + ".ops"));
  std::string flat;
  for (std::string line; std::getline(lines, line);)
    if (line != "drape") flat += line + "\n";
  write(script, flat);
  const Said played = karinui("play " + script + " -o " + document);
  ASSERT_EQ(played.exit, 0) << played.err;
  const auto walked = karinui("truing " + document + " --json").json();
  for (const auto& seam : walked["seams"]) EXPECT_EQ(seam["fits"], true) << seam.dump();
  EXPECT_LE(walked["faults"], GetParam().corners);
  ASSERT_EQ(karinui("export " + document + " -o " + (folder / "paper.svg")).exit, 0);
  const std::string paper = contents(folder / "paper.svg");
  int doubled = 0;
  for (auto at = paper.find("Cut 2"); at != std::string::npos; at = paper.find("Cut 2", at + 1)) ++doubled;
  EXPECT_EQ(doubled, GetParam().doubled);
}

INSTANTIATE_TEST_SUITE_P(All, ExamplesOnPaper,
                         testing::Values(OnPaper{"tailored_shirt", 4, 0}, OnPaper{"pleated_skirt", 1, 0},
                                         OnPaper{"lined_waistcoat", 4, 24}, OnPaper{"trousers", 2, 3},
                                         OnPaper{"gathered_dress", 0, 4}, OnPaper{"hooded_coat", 0, 6}),
                         [](const auto& name) { return name.param.name; });

// Garments as one would wear them, and the six operations. Those that take longest in ./test --long only.
class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, ComeToRestWithNothingThroughAnything) {
  const char* asked = std::getenv("KARINUI_LONG");
  const std::set<std::string> slow{"lined_waistcoat", "skirt_with_train", "gathered_dress", "pleated_skirt"};
  if (slow.contains(GetParam()) && !(asked && *asked)) GTEST_SKIP() << "./test --long";
  const Folder folder;
  const std::string document = folder / "garment.karinui";
  const Said played = karinui("play " KARINUI_SOURCE_DIR "/examples/" + GetParam() + ".ops -o " + document);
  EXPECT_EQ(played.exit, 0) << played.err;  // each of its drapes came to rest
  const auto found = karinui("check " + document + " --json").json();
  EXPECT_EQ(found["penetration_mm"], 0);
  EXPECT_LE(found["seam_gap_mm"].get<double>(), 0.001);
  for (const char* crossings : {"cloth_body_crossings", "cloth_cloth_crossings", "fold_crossings"})
    EXPECT_EQ(found[crossings], 0) << crossings;
  EXPECT_GT(found["pressure_p99_kpa"], found["pressure_mean_kpa"]);
  EXPECT_LT(found["pressure_p99_kpa"], 4.0);  // no tourniquet: 5 kPa and more
  for (const auto& fastening : found.value("fastenings", nlohmann::json::array()))
    EXPECT_EQ(fastening["holds"], true) << fastening.dump();
  const Said paper = karinui("export " + document + " -o " + (folder / "pattern.pdf"));
  EXPECT_EQ(paper.exit, 0) << paper.err;
  // Worn: the body moves, the garment goes with it and is not torn. A sleeve that ran ahead of its shirt was stretched
  // fourteen times over.
  std::vector<const char*> poses;
  if (GetParam() == "tailored_shirt") poses = {"overhead"};
  if (asked && *asked) poses = {"T", "overhead", "seated", "bent", "step"};
  for (const char* pose : poses) {
    SCOPED_TRACE(pose);
    const Said posed = karinui("do " + document + " 'pose name=" + pose + "'");
    EXPECT_EQ(posed.exit, 0) << posed.err;
    const auto carried = karinui("check " + document + " --json").json();
    EXPECT_LE(carried["seam_gap_mm"].get<double>(), 0.001);
    EXPECT_LT(carried["strain_p99"], 0.5);
    EXPECT_LT(carried["strain_max"], 1.0);
    if (!(asked && *asked)) continue;
    const Said rested = karinui("settle " + document);
    EXPECT_EQ(rested.exit, 0) << rested.err;
    const auto stands = karinui("check " + document + " --json").json();
    for (const char* crossings : {"cloth_body_crossings", "cloth_cloth_crossings", "fold_crossings"})
      EXPECT_EQ(stands[crossings], 0) << crossings;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Examples,
                         testing::Values("six_operations", "trousers", "tailored_shirt", "pleated_skirt",
                                         "gathered_dress", "hooded_coat", "skirt_with_train", "buttoned_waistcoat",
                                         "lined_waistcoat"),
                         [](const auto& name) { return name.param; });

INSTANTIATE_TEST_SUITE_P(All, DrapedPatterns,
                         testing::Values(Draft{"bodice_block_f_eu38.svg", "f_eu38"},
                                         Draft{"tshirt_f_eu38.svg", "f_eu38"},
                                         Draft{"pencil_skirt_f_eu38.svg", "f_eu38"},
                                         Draft{"trouser_block_m_eu50.svg", "m_eu50", false, true},
                                         Draft{"shirt_m_eu50.svg", "m_eu50", false, true},
                                         Draft{"tshirt_m_eu50.svg", "m_eu50", false, true},
                                         Draft{"body_block_m_eu50.svg", "m_eu50", false, true},
                                         Draft{"garmentcode/dress_pencil_specification.json", "f_eu38", true, true},
                                         Draft{"garmentcode/shirt_mean_specification.json", "f_eu38", true, true}),
                         [](const auto& draft) { return std::filesystem::path(draft.param.pattern).stem().string(); });

}  // namespace
}  // namespace karinui::test
