// What the command says of touch.
#include "apps/command.h"

namespace karinui::test {
namespace {

const char* const kSheet =
    "piece name=front outline=\"M 0 0; hem L 400 0; side_left L 400 500; neck L 0 500; side_right L 0 0\"\n";

// A hand that goes to the cloth in the plane z = 0, presses its button there, goes on by `by`, stays, and lets go.
std::string hand(const std::string& from, const std::string& press, const std::string& to) {
  const auto line = [](const std::string& phase, const std::string& seconds, const std::string& place) {
    return phase + " space " + seconds + " 0 0 1 0 0 -1 0 0 1 reach 0.01 tip " + place + " 1 0 0 0 device stylus\n";
  };
  return "# a hand\n" + line("hover", "0", from) + line("hover", "0.5", press) + line("press", "0.6", press) +
         line("drag", "1.6", to) + line("drag", "3", to) + line("release", "3.1", to) + line("hover", "3.5", to);
}

class Touch : public testing::Test {
 protected:
  Folder folder;
  void SetUp() override {
    write(folder / "sheet.ops", kSheet);
    ASSERT_EQ(karinui("play " + (folder / "sheet.ops") + " -o " + (folder / "d.karinui")).exit, 0);
  }
  Said replay(const std::string& recorded, const std::string& more = "") {
    write(folder / "hand.txt", recorded);
    return karinui("touch replay " + (folder / "hand.txt") + " " + (folder / "d.karinui") + " --json " + more);
  }
};

TEST_F(Touch, AReplayTellsWhatTheHandFeels) {
  // 3 mm into the cloth: a half of 400 N/m.
  const std::string pressing = hand("0.2 0.2 0.02", "0.2 0.2 0.005", "0.2 0.2 -0.003");
  const Said touched = replay(pressing);
  ASSERT_EQ(touched.exit, 0) << touched.err;
  const auto ticks = touched.json()["ticks"];
  ASSERT_GT(ticks.size(), 300u);
  EXPECT_EQ(ticks[0]["newtons"], 0);
  EXPECT_EQ(ticks[20]["state"], "armed");
  EXPECT_NEAR(ticks[250]["force"][2].get<double>(), 0.5 * 400 * 0.003, 0.02);
  EXPECT_TRUE(ticks[250]["touching"].get<bool>());
  EXPECT_EQ(replay(pressing).out, touched.out) << "the same hand feels the same";
  EXPECT_NEAR(replay(pressing, "--gain 1").json()["most_newtons"].get<double>(), 400 * 0.003, 0.05);
  EXPECT_LE(replay(pressing, "--gain 1 --limit 0.5").json()["most_newtons"].get<double>(), 0.5);
  // Carried: 0.4 x 0.5 m of cotton.
  const auto carried = replay(hand("0.2 0.2 0.02", "0.2 0.2 0.005", "0.2 0.2 0.2"), "--tool move --gain 1").json();
  EXPECT_NEAR(carried["ticks"][250]["force"][1].get<double>(), -0.4 * 0.5 * 0.15 * 9.81, 0.02);
  EXPECT_EQ(carried["ticks"].back()["newtons"].get<double>(), 0) << "let go";
  // The recording says what is held, unless it is said otherwise.
  const std::string moving = "tool move\n" + hand("0.2 0.2 0.02", "0.2 0.2 0.005", "0.2 0.2 0.2");
  EXPECT_EQ(replay(moving, "--gain 1").json()["ticks"], carried["ticks"]);
  EXPECT_NE(replay(moving, "--gain 1 --tool touch").json()["ticks"], carried["ticks"]);
  const Said unknown = replay("tool saw\n" + pressing);
  EXPECT_EQ(unknown.exit, 3);
  EXPECT_NE(unknown.err.find("Line 1: there is no tool “saw”"), std::string::npos) << unknown.err;
  // Pulled: towards where it was.
  const auto pulled = replay(hand("0.2 0.2 0.02", "0.2 0.2 0.003", "0.2 0.2 0.006"), "--tool pull --gain 1").json();
  EXPECT_NEAR(pulled["ticks"][61]["newtons"].get<double>(), 0, 0.02) << "nothing pulls where it was taken";
  EXPECT_LT(pulled["ticks"][250]["force"][2].get<double>(), -0.05);
}

TEST_F(Touch, AReplayWritesATableForResearchers) {
  const std::string pressing = hand("0.2 0.2 0.02", "0.2 0.2 0.005", "0.2 0.2 -0.003");
  const auto ticks = replay(pressing).json()["ticks"];
  const Said said = replay(pressing, "--csv " + (folder / "force.csv"));
  ASSERT_EQ(said.exit, 0) << said.err;
  std::istringstream lines(contents(folder / "force.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "time_s,tip_x_m,tip_y_m,tip_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_n,force_y_n,force_z_n");
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    ASSERT_EQ(row.size(), 10u) << line;
    if (rows >= ticks.size()) continue;
    const auto& tick = ticks[rows];
    EXPECT_NEAR(row[0], tick["seconds"].get<double>(), 1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(row[1 + k], tick["tip"][k].get<double>());
      EXPECT_EQ(row[4 + k], tick["proxy"][k].get<double>());
      EXPECT_EQ(row[7 + k], tick["force"][k].get<double>());
    }
    if (rows == 250) {
      EXPECT_NEAR(row[6], 0, 1e-4) << "the proxy stays on the sheet at z = 0";
      EXPECT_NEAR(row[3], -0.003, 1e-9);
    }
    if (rows == 0) {
      EXPECT_EQ(row[6], row[3]) << "in free air it is at the tip";
    }
  }
  EXPECT_EQ(rows, ticks.size());
  EXPECT_EQ(replay(pressing, "--csv " + (folder / "force.txt")).exit, 3);
  // What the force of a pull is, and is not, is told.
  write(folder / "hand.txt", pressing);
  const Said told = karinui("touch replay " + (folder / "hand.txt") + " " + (folder / "d.karinui") + " --tool pull");
  EXPECT_NE(told.out.find("times the gain of 0.5, at most 2.64 N."), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("The cloth does not follow meanwhile"), std::string::npos);
}

TEST_F(Touch, WhatIsNoHandIsRefused) {
  const Said said = replay("hover space 0 0 0 1 0 0 -1 0 0 1 reach 0.01\n");
  EXPECT_EQ(said.exit, 3);
  EXPECT_NE((said.out + said.err).find("no tip in space"), std::string::npos);
  EXPECT_EQ(replay(hand("0 0 0", "0 0 0", "0 0 0"), "--tool knit").exit, 2);
}

TEST_F(Touch, ACheckMeasuresTheLoop) {
  const Said said = karinui("touch check --seconds 0.5 --json");
  ASSERT_EQ(said.exit, 0) << said.err;
  const auto answer = said.json();
  EXPECT_GT(answer["ticks"].get<int>(), 50);
  EXPECT_GT(answer["facets"].get<int>(), 20);
  EXPECT_GT(answer["evaluation_us"]["p99"].get<double>(), 0);
  EXPECT_GE(answer["lateness_us"]["max"].get<double>(), answer["lateness_us"]["p50"].get<double>());
  EXPECT_FALSE(answer["promise"].get<std::string>().empty());
  // The latency budget: every part was measured, and the sums hold them.
  const auto& latency = answer["latency_us"];
  for (const char* share : {"p50", "p99"}) {
    const auto part = [&](const char* name) { return latency[name][share].get<double>(); };
    for (const char* name : {"servo_wake_up", "device_round_trip", "scene_made", "scene_age", "evaluation"})
      EXPECT_GT(part(name), 0) << name;
    EXPECT_NEAR(part("hand_to_force"),
                part("servo_wake_up") + std::max(1000.0, part("device_round_trip")) + part("evaluation"), 1e-6);
    EXPECT_NEAR(part("scene_to_force"), part("scene_made") + part("scene_age") + part("evaluation"), 1e-6);
    EXPECT_GT(part("scene_age"), part("evaluation")) << "a scene is made every 16 ms";
  }
  ASSERT_EQ(answer["devices"].size(), 4u);
  EXPECT_TRUE(answer["devices"][3]["found"].get<bool>());
  EXPECT_NE(karinui("touch check --seconds 0.2", "ja_JP.UTF-8").out.find("力の制御ループ"), std::string::npos);
}

}  // namespace
}  // namespace karinui::test
