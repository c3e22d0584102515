// Many garments on many people: the same table byte for byte, however it was done.
#include <dirent.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <set>

#include "apps/command.h"

namespace karinui::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A band round the waist, coarsely laid: quick to settle.
std::string band(int mm) {
  const std::string width = std::to_string(mm);
  return "body size=jis9ar\nset spacing=50mm\npiece name=band outline=\"M 0 0; low L " + width + " 0; end_right L " +
         width +
         " 150; top L 0 150; end_left L 0 0\"\nplace piece=band at=\"torso:waist@0\" ease=2cm\n"
         "sew a=band.end_left b=band.end_right\n";
}

const char* const kPeople =
    "name,sex,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm,shoe\n"
    "small,f,152,78,60,85,35\n\"Sato, Hana\",f,158,83,64,91,36\ngiant,f,400,88,70,96,40\n"
    "wide,f,160,112,98,118,38\nthin,f,162,104,10,110,38\nnobody,f,158,500,64,91,36\n";

class Batch : public testing::Test {
 protected:
  Folder folder;
  std::string run(const std::string& name) const { return folder / name; }

  void SetUp() override {
    fs::create_directory(folder / "designs");
    write(folder / "designs/band.ops", band(820));
    write(folder / "loose.ops", band(1250) + "pin edge=band.top\n");
    ASSERT_EQ(karinui("play " + (folder / "loose.ops") + " -o " + (folder / "designs/loose.karinui")).exit, 0);
    write(folder / "people.csv", kPeople);
  }
  Said plan(const std::string& name) {
    return karinui("batch plan " + (folder / "designs") + " " + (folder / "people.csv") + " -o " + run(name) +
                   " --json");
  }
  void merge(const std::string& name) {
    const Said merged = karinui("batch merge " + run(name) + " --json");
    ASSERT_EQ(merged.exit, 0) << merged.err;
    EXPECT_EQ(merged.json()["missing"], 0);
  }
  std::size_t kept(const std::string& name) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(run(name) + "/items")) count += entry.path().extension() == ".json";
    return count;
  }
  // What a pattern-maker reads of the twelve, in both languages; always the same bytes.
  void expectReport(const std::string& name) const {
    const std::string out = folder / "fit.pdf";
    ASSERT_EQ(karinui("batch report " + run(name) + " -o " + out).exit, 0);
    const std::string bytes = contents(out);
    ASSERT_EQ(karinui("batch report " + run(name) + " -o " + out).exit, 0);
    EXPECT_EQ(contents(out), bytes);
    if (std::system("command -v pdftotext >/dev/null") != 0) return;
    const std::string text = printed(out);
    EXPECT_THAT(text, HasSubstr("Fit over 6 people, 12 garments"));
    EXPECT_THAT(text, HasSubstr("Pressure: 99 % of the skin"));
    EXPECT_THAT(text, HasSubstr("Ease, garment less body: loose"));
    EXPECT_THAT(text, testing::ContainsRegex("wide +band +112.0 +98.0 +118.0 +too small +[0-9]+ cm +[0-9]+ cm above"));
    EXPECT_THAT(text, testing::ContainsRegex("giant .* refused: height cannot be 400.0 cm"));
    EXPECT_LT(text.rfind("too small"), text.find("refused: ")) << "the worst first";
    ASSERT_EQ(karinui("batch report " + run(name) + " --language ja -o " + out).exit, 0);
    EXPECT_THAT(printed(out), HasSubstr("6 人、12 着のフィット"));
    EXPECT_THAT(printed(out), testing::ContainsRegex("小さい +[0-9]+ cm +床から"));
  }
  std::string printed(const std::string& pdf) const {
    EXPECT_EQ(std::system(("pdftotext -layout '" + pdf + "' '" + (folder / "printed") + "'").c_str()), 0);
    return contents(folder / "printed");
  }
  void expectSame(const std::string& a, const std::string& b) const {
    for (const char* file : {"table.csv", "table.sqlite"})
      EXPECT_EQ(contents(run(a) + "/" + file), contents(run(b) + "/" + file)) << file << " of " << b;
  }
};

// The processes whose command line holds all of these.
std::vector<pid_t> processes(const std::vector<std::string>& with) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0) continue;
    const std::string words = contents((entry.path() / "cmdline").string());
    if (std::all_of(with.begin(), with.end(), [&](const auto& word) { return words.find(word) != std::string::npos; }))
      found.push_back(pid);
  }
  return found;
}
// Waits until there is one, or the condition has come true; 0: none came.
pid_t waitFor(const std::vector<std::string>& with) {
  for (int i = 0; i < 3000; ++i) {
    if (const auto found = processes(with); !found.empty()) return found.front();
    ::usleep(10'000);
  }
  return 0;
}

TEST_F(Batch, IsTheSameSerialInPartsAndAfterItWasKilled) {
  const Said planned = plan("serial");
  ASSERT_EQ(planned.exit, 0) << planned.err;
  EXPECT_EQ(planned.json()["items"], 12);
  EXPECT_THAT(planned.err, HasSubstr("“shoe” has no counterpart"));
  ASSERT_EQ(plan("parts").exit, 0);
  ASSERT_EQ(plan("killed").exit, 0);
  EXPECT_EQ(contents(run("serial") + "/manifest.json"), contents(run("parts") + "/manifest.json"));
  EXPECT_EQ(karinui("batch merge " + run("serial") + " --json").json()["missing"], 12);

  // Another process is killed in its midst, and one of its items falls down.
  const std::string command =
      "'" KARINUI_COMMAND "' batch run " + run("killed") + " --threads 1 --attempts 1 >/dev/null 2>&1";
  ASSERT_EQ(std::system((command + " &").c_str()), 0);
  const pid_t first = waitFor({"batch", "item", run("killed")});
  ASSERT_NE(first, 0);
  ::kill(first, SIGSEGV);
  for (int i = 0; i < 3000 && kept("killed") < 3; ++i) ::usleep(10'000);
  for (const pid_t pid : processes({"batch", "run", run("killed")})) ::kill(pid, SIGKILL);
  for (int i = 0; i < 3000 && !processes({run("killed")}).empty(); ++i) ::usleep(10'000);
  EXPECT_TRUE(processes({run("killed")}).empty()) << "the children go with it";
  const std::size_t before = kept("killed");
  EXPECT_GE(before, 3u);
  EXPECT_LT(before, 12u);
  Said merged = karinui("batch merge " + run("killed") + " --json");
  EXPECT_EQ(merged.json()["outcomes"]["crashed"], 1) << merged.out;
  EXPECT_THAT(contents(run("killed") + "/table.csv"), HasSubstr("Segmentation fault"));
  EXPECT_THAT(merged.err, HasSubstr("not done yet"));

  // Two parts at a time, the serial one, and the rest of the killed one.
  const std::string part = "'" KARINUI_COMMAND "' batch run " + run("parts") + " --threads 1 >/dev/null 2>&1 --shard ";
  ASSERT_EQ(std::system((part + "1/2 & " + part + "2/2 && wait $!").c_str()), 0);
  const Said serial = karinui("batch run " + run("serial") + " --jobs 2 --json");
  ASSERT_EQ(serial.exit, 0) << serial.err;
  EXPECT_EQ(serial.json()["done"], 12);
  EXPECT_THAT(serial.err, HasSubstr("12 of 12: "));
  const Said resumed = karinui("batch run " + run("killed") + " --retry --json");
  ASSERT_EQ(resumed.exit, 0) << resumed.err;
  EXPECT_EQ(resumed.json()["before"], before - 1);
  EXPECT_EQ(karinui("batch run " + run("serial") + " --json").json()["done"], 0) << "what is done is left alone";
  for (const char* name : {"serial", "parts", "killed"}) merge(name);
  expectSame("serial", "parts");
  expectSame("serial", "killed");

  // What came of it.
  const std::string table = contents(run("serial") + "/table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 13);
  EXPECT_THAT(table, HasSubstr("\"Sato, Hana\""));
  EXPECT_THAT(table, HasSubstr(",band,nobody,female,,refused,"));
  EXPECT_THAT(table, HasSubstr(",band,wide,female,,did not settle,\"Too small by"));
  EXPECT_THAT(table, HasSubstr(",loose,wide,female,,ok,"));
  EXPECT_THAT(table, HasSubstr(",too small,"));
  expectReport("serial");
  const Said rows = karinui("batch merge " + run("serial") + " --json");
  EXPECT_EQ(rows.json()["outcomes"]["ok"].get<int>() + rows.json()["outcomes"]["refused"].get<int>() +
                rows.json()["outcomes"].value("did not settle", 0),
            12)
      << rows.out;
}

TEST_F(Batch, TellsWhatIsWrongAndOverwritesNothing) {
  ASSERT_EQ(plan("one").exit, 0);
  EXPECT_EQ(plan("one").exit, 0) << "the same plan is left as it is";
  write(folder / "people.csv", "height_cm\n160\n");
  Said said = plan("one");
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("holds another batch"));
  write(folder / "people.csv", "height_cm\nlong\n");
  said = plan("two");
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("people.csv: Row 2 of the table"));
  EXPECT_FALSE(fs::exists(run("two")));
  EXPECT_THAT(
      karinui("batch plan " + (folder / "people.csv") + " " + (folder / "people.csv") + " -o " + run("two")).err,
      HasSubstr("documents"));
  EXPECT_THAT(karinui("batch run " + folder / "designs").err, HasSubstr("holds no batch"));
  EXPECT_EQ(karinui("batch run " + run("one") + " --shard 3/2").exit, 2);
  EXPECT_EQ(karinui("batch run " + run("one") + " --shard half").exit, 2);
  std::string manifest = contents(run("one") + "/manifest.json");
  manifest.replace(manifest.find("0.78"), 4, "0.79");
  write(run("one") + "/manifest.json", manifest);
  EXPECT_THAT(karinui("batch run " + run("one")).err, HasSubstr("changed by hand"));
  EXPECT_EQ(kept("one"), 0u);
  ASSERT_EQ(plan("three").exit, 3);
  write(folder / "people.csv", kPeople);
  ASSERT_EQ(plan("three").exit, 0);
  said = karinui("batch report " + run("three") + " -o " + (folder / "fit.pdf"));
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("Nothing of this batch is done yet"));
  EXPECT_FALSE(fs::exists(folder / "fit.pdf"));
}

TEST_F(Batch, AnItemThatTakesTooLongIsTold) {
  write(folder / "designs/band.ops", band(1250) + "set spacing=3mm\ndrape\n");
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "people.csv", "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nsmall,152,78,60,85\n");
  ASSERT_EQ(plan("slow").exit, 0);
  const Said done = karinui("batch run " + run("slow") + " --seconds 1");
  EXPECT_EQ(done.exit, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("band on small: timeout"));
  EXPECT_TRUE(processes({"batch", "item", run("slow")}).empty());
}

// What killed a garment may be gone the second time; what is an answer is the same every time.
TEST_F(Batch, EachCauseHasItsRetries) {
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "people.csv",
        "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nsmall,152,78,60,85\nwide,160,112,98,118\n"
        "giant,400,88,70,96\n");
  ASSERT_EQ(plan("run").exit, 0);
  // A worker is killed once, and the item is started again.
  ASSERT_EQ(std::system(("'" KARINUI_COMMAND "' batch run " + run("run") + " >/dev/null 2>&1 &").c_str()), 0);
  const pid_t first = waitFor({"batch", "item", run("run")});
  ASSERT_NE(first, 0);
  ::kill(first, SIGKILL);
  for (int i = 0; i < 3000 && !processes({"batch", "run", run("run")}).empty(); ++i) ::usleep(10'000);
  merge("run");
  const std::string table = contents(run("run") + "/table.csv");
  EXPECT_THAT(table, HasSubstr(",band,small,female,,ok,"));
  EXPECT_EQ(karinui("batch run " + run("run") + " --retry --json").json()["done"], 0)
      << "neither what was refused nor what did not settle";
  // Outcomes as a slow machine would have left them.
  for (const auto& entry : fs::directory_iterator(run("run") + "/items")) {
    nlohmann::json item = nlohmann::json::parse(contents(entry.path().string()));
    if (item["outcome"] == "refused") item["outcome"] = "crashed";
    if (item["outcome"] == "ok") item["outcome"] = "timeout", item["seconds"] = 30;
    write(entry.path().string(), item.dump());
  }
  EXPECT_EQ(karinui("batch run " + run("run") + " --json").json()["done"], 0) << "only when asked";
  EXPECT_EQ(karinui("batch run " + run("run") + " --retry --seconds 30 --json").json()["done"], 1) << "the crash";
  EXPECT_EQ(karinui("batch run " + run("run") + " --retry --seconds 60 --json").json()["done"], 1) << "the timeout";
  merge("run");
  EXPECT_EQ(contents(run("run") + "/table.csv"), table);
}

// Ten designs' worth of people; by ./test --long.
TEST_F(Batch, TwoHundredGarmentsAreTheSameSerialAndInParts) {
  if (const char* asked = std::getenv("KARINUI_LONG"); !asked || !*asked) GTEST_SKIP() << "only by ./test --long";
  std::string people = "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\n";
  for (int i = 0; i < 100; ++i)
    people += "p" + std::to_string(i) + "," + std::to_string(150 + i % 30) + "," + std::to_string(78 + i % 23) + "," +
              std::to_string(60 + i % 21) + "," + std::to_string(86 + i % 19) + "\n";
  write(folder / "people.csv", people);
  ASSERT_EQ(plan("a").json()["items"], 200);
  ASSERT_EQ(plan("b").exit, 0);
  ASSERT_EQ(karinui("batch run " + run("a") + " --jobs 2").exit, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    ASSERT_EQ(karinui("batch run " + run("b") + " --jobs 2 --shard " + shard).exit, 0);
  merge("a"), merge("b");
  expectSame("a", "b");
}

TEST_F(Batch, IsHandedToSlurm) {
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "people.csv", "height_cm,waist_girth_cm,bust_girth_cm,hip_girth_cm\n158,64,83,91\n152,60,78,85\n");
  ASSERT_EQ(plan("shell").exit, 0);
  ASSERT_EQ(plan("cluster").exit, 0);
  EXPECT_EQ(karinui("batch submit " + run("cluster") + " --slurm --partition 'a b'").exit, 3);
  const bool here = std::system("sinfo >/dev/null 2>&1") == 0;
  const auto submit = [&](const std::string& name) {
    return karinui("batch submit " + run(name) + " --slurm --shards 3 --threads 1 --time 10:00");
  };
  // Where there is no sbatch the script stays.
  const Said alone =
      karinui("batch submit " + run("shell") + " --slurm --shards 3 --partition debug", "C PATH=/nowhere");
  EXPECT_EQ(alone.exit, 3);
  EXPECT_THAT(alone.err, HasSubstr("slurm.sh"));
  const std::string script = contents(run("shell") + "/slurm.sh");
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-3\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --partition=debug\n"));
  EXPECT_THAT(script, HasSubstr("--shard \"$SLURM_ARRAY_TASK_ID/3\""));
  // What a shell makes of the jobs, one number of the array after another.
  for (const char* number : {"1", "2", "3"})
    ASSERT_EQ(std::system(("SLURM_ARRAY_TASK_ID=" + std::string(number) + " bash '" + run("shell") +
                           "/slurm.sh' >/dev/null 2>&1")
                              .c_str()),
              0);
  merge("shell");
  if (!here) GTEST_SKIP() << "Slurm is not running here: nothing was submitted";
  const Said said = submit("cluster");
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("Submitted as job "));
  for (int i = 0; i < 6000 && kept("cluster") < 2; ++i) ::usleep(20'000);
  merge("cluster");
  expectSame("shell", "cluster");
}

}  // namespace
}  // namespace karinui::test
