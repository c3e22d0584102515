// A garment on ten bodies, ten times in a row on one, two and four threads: what it comes to is the same each time, and
// what is said to rest neither enters the body nor crosses itself. A body that the garment cannot be drawn on is
// refused by the step that cannot be done. By ./test --long.
#include "apps/command.h"
#include "soak.h"

namespace karinui::test {
namespace {

namespace fs = std::filesystem;

TEST(WholeGarments, OnTenBodiesAreTenTimesTheSame) {
  if (!atLength()) GTEST_SKIP() << "by ./test --long";
  std::vector<std::string> bodies{"jis9ar", "eu38", "eu50"};
  for (const char* name : {"f_eu38", "f_jis9ar", "f_plus", "m_eu50", "m_tall", "neutral_female", "neutral_male"})
    if (const fs::path body = fs::path(KARINUI_SHARED_DIR) / "bodies" / (std::string(name) + ".obj"); fs::exists(body))
      bodies.push_back(body.string());
  const Folder folder;
  std::string script = contents(KARINUI_SOURCE_DIR "/examples/first_tunic.ops");
  ASSERT_TRUE(script.ends_with("\ndrape\n"));
  write(folder / "sewn.ops", script.erase(script.size() - 6));
  ASSERT_EQ(karinui("play " + (folder / "sewn.ops") + " -o " + (folder / "tunic.karinui")).exit, 0);
  std::size_t wearers = 0, rested = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    SCOPED_TRACE(bodies[k]);
    const std::string sewn = folder / ("sewn" + std::to_string(k) + ".karinui");
    const Said refitted = karinui("refit " + (folder / "tunic.karinui") + " --body " + bodies[k] + " -o " + sewn);
    if (refitted.exit == 3) {
      EXPECT_NE(refitted.err.find("cannot be done on this body"), std::string::npos) << refitted.err;
      std::cout << bodies[k] << ": " << refitted.err.substr(refitted.err.rfind("karinui: ")) << std::flush;
      continue;
    }
    ASSERT_EQ(refitted.exit, 0) << refitted.err;
    ++wearers;
    std::string first;
    for (int run = 0; run < 10; ++run) {
      const std::string worn = folder / "worn.karinui";
      fs::copy_file(sewn, worn, fs::copy_options::overwrite_existing);
      const int threads[] = {1, 2, 4};
      const Said said = karinui("settle " + worn + " --json --threads " + std::to_string(threads[run % 3]));
      const auto rest = said.json();
      ASSERT_TRUE(said.exit == 0 || said.exit == 4) << said.err;
      ASSERT_EQ(rest["finite"], true);
      ASSERT_EQ(rest["kept"], false) << "draped anew";
      if (rest["settled"] == true) {
        EXPECT_LE(rest["penetration_mm"].get<double>(), 0.1);
        EXPECT_EQ(rest["cloth_body_crossings"], 0);
        EXPECT_EQ(rest["cloth_cloth_crossings"], 0);
        EXPECT_LE(rest["seam_gap_mm"].get<double>(), 0.1);
        ++rested;
      }
      const std::string stands = karinui("info " + worn + " --json").json()["drape_hash"];
      if (run == 0) first = stands;
      ASSERT_EQ(stands, first) << "run " << run << ", " << threads[run % 3] << " threads";
    }
  }
  std::cout << wearers << " of " << bodies.size() << " bodies wear it; " << rested << " of " << 10 * wearers
            << " drapes rest\n";
  EXPECT_GT(wearers, bodies.size() / 2);
  EXPECT_GT(rested, 5 * wearers) << "most of them rest";
}

// Sleeves with tight cuffs. Each time the elbows are bent a little further, or the rests of the first time would be
// taken up again.
TEST(WholeGarments, ArmsGoUpAndDown) {
  if (!atLength()) GTEST_SKIP() << "by ./test --long";
  const Folder folder;
  std::string script = contents(KARINUI_SOURCE_DIR "/examples/tailored_shirt.ops");
  for (int k = 0; k < 10; ++k)
    for (const char* pose : {"overhead", "arms_down"})
      script += "pose name=" + std::string(pose) + " joint=elbow flex=" + std::to_string(2 * k + 1) + "deg\ndrape\n";
  write(folder / "arms.ops", script);
  const Said said = karinui("play " + (folder / "arms.ops") + " -o " + (folder / "arms.karinui"));
  EXPECT_EQ(said.exit, 0) << said.err;
  EXPECT_EQ(said.err.find("did not come to rest"), std::string::npos) << said.err;
  const auto stands = karinui("check " + (folder / "arms.karinui") + " --json").json();
  EXPECT_EQ(stands["cloth_body_crossings"], 0);
  EXPECT_EQ(stands["cloth_cloth_crossings"], 0);
  EXPECT_LE(stands["penetration_mm"].get<double>(), 0.1);
}

// Each example on its figure in five poses, at rest in each. Cloth that the arms crumple in the armpits had passed
// through itself there.
TEST(WholeGarments, ComeToRestInEveryPose) {
  if (!atLength()) GTEST_SKIP() << "by ./test --long";
  for (const std::string name : {"tailored_shirt", "shirt_fitting", "hooded_coat", "lined_waistcoat", "trousers",
                                 "pleated_skirt", "gathered_dress", "first_tunic"}) {
    const Folder folder;
    const std::string own = folder / "own.karinui", posed = folder / "posed.karinui";
    ASSERT_EQ(karinui("play '" KARINUI_SOURCE_DIR "/examples/" + name + ".ops' -o " + own).exit, 0) << name;
    for (const std::string pose : {"T", "overhead", "seated", "step", "forward"}) {
      SCOPED_TRACE(name + ", " + pose);
      fs::copy_file(own, posed, fs::copy_options::overwrite_existing);
      ASSERT_EQ(karinui("do " + posed + " 'pose name=" + pose + "'").exit, 0);
      const Said said = karinui("settle " + posed);
      EXPECT_EQ(said.exit, 0) << said.err;
      const auto stands = karinui("check " + posed + " --json").json();
      EXPECT_EQ(stands["cloth_body_crossings"], 0);
      EXPECT_EQ(stands["cloth_cloth_crossings"], 0);
      EXPECT_LE(stands["penetration_mm"].get<double>(), 0.1);
    }
  }
}

}  // namespace
}  // namespace karinui::test
