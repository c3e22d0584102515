// Many garments on many people: the same table byte for byte, however it was done.
#include <dirent.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <set>

#include "apps/command.h"
#include "karinui/base/hash.h"

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
    static std::string loose;  // played once for all tests of this program
    if (loose.empty()) {
      write(folder / "loose.ops", band(1250) + "pin edge=band.top\n");
      ASSERT_EQ(karinui("play " + (folder / "loose.ops") + " -o " + (folder / "loose.karinui")).exit, 0);
      loose = contents(folder / "loose.karinui");
    }
    write(folder / "designs/loose.karinui", loose);
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
    std::string words;
    try {
      words = contents((entry.path() / "cmdline").string());
    } catch (const std::exception&) {  // it has ended meanwhile
      continue;
    }
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

  // It is full of measures: its owner's alone.
  const auto mode = [](const fs::path& path) { return static_cast<unsigned>(fs::status(path).permissions()); };
  for (const auto& entry : fs::recursive_directory_iterator(run("serial")))
    EXPECT_EQ(mode(entry.path()), entry.is_directory() ? 0700u : 0600u) << entry.path();
  EXPECT_EQ(mode(run("serial")), 0700u);

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
    item.erase("seal");
    item["seal"] = Hasher().add(std::string_view(item.dump())).hex();
    write(entry.path().string(), item.dump());
  }
  EXPECT_EQ(karinui("batch run " + run("run") + " --json").json()["done"], 0) << "only when asked";
  EXPECT_EQ(karinui("batch run " + run("run") + " --retry --seconds 30 --json").json()["done"], 1) << "the crash";
  EXPECT_EQ(karinui("batch run " + run("run") + " --retry --seconds 60 --json").json()["done"], 1) << "the timeout";
  merge("run");
  EXPECT_EQ(contents(run("run") + "/table.csv"), table);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// What a machine has no memory for is no answer: another does it, and the table is the same.
TEST_F(Batch, WantOfMemoryIsNoAnswer) {
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "designs/band.ops",
        band(820) + "set spacing=4mm\n");  // needs twice what the one who hands it out does
  write(folder / "people.csv", "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nsmall,152,78,60,85\n");
  ASSERT_EQ(plan("poor").exit, 0);
  ASSERT_EQ(plan("rich").exit, 0);
  // With the least that the one who hands out the work can do with, which is not enough for the work: a figure that was
  // made before would be.
  Said said;
  for (int megabytes = 40; megabytes < 200 && said.exit != 0; megabytes += 4)
    said = karinui("batch run " + run("poor") + " --json",
                   "C env -u KARINUI_FIGURES sh -c 'ulimit -v " + std::to_string(megabytes) + "000; exec \"$@\"' sh ");
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.err, HasSubstr("band on small: out of memory"));
  EXPECT_THAT(said.err,
              HasSubstr("1 item crashed, or lacked memory or time; karinui batch run --retry does it again."));
  EXPECT_EQ(said.json()["hindered"], 1);
  merge("poor");
  EXPECT_THAT(contents(run("poor") + "/table.csv"),
              HasSubstr(",out of memory,\"There is not enough memory for this. "));
  EXPECT_EQ(karinui("batch run " + run("poor") + " --json").json()["done"], 0) << "only when asked";
  said = karinui("batch run " + run("poor") + " --retry --json");
  EXPECT_EQ(said.json()["done"], 1) << said.err;
  EXPECT_EQ(said.json()["hindered"], 0);
  EXPECT_EQ(karinui("batch run " + run("rich")).exit, 0);
  for (const char* name : {"poor", "rich"}) merge(name);
  expectSame("poor", "rich");
}
#endif

TEST_F(Batch, WhatHindersThisMachineIsSaidAndKeptNowhere) {
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "people.csv", "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nsmall,152,78,60,85\n");
  ASSERT_EQ(plan("run").exit, 0);
  fs::remove(run("run") + "/items");
  Said said = karinui("batch run " + run("run"));
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, testing::ContainsRegex("band on small: .*/items/.*cannot be written: there is no such folder"));
  fs::create_directory(run("run") + "/items");
  EXPECT_EQ(karinui("batch run " + run("run") + " --json").json()["done"], 1);
}

// What lies in the folder is what was planned and what came of it, or it is not used.
TEST_F(Batch, WhatWasChangedByHandIsNotTaken) {
  write(folder / "people.csv", "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\nsmall,152,78,60,85\n");
  ASSERT_EQ(plan("run").exit, 0);
  for (const auto& entry : fs::directory_iterator(run("run") + "/designs")) {
    const std::string copy = entry.path().string(), before = contents(copy);
    if (entry.path().extension() == ".karinui")
      ASSERT_EQ(karinui("undo " + copy).exit, 0);
    else
      write(copy, band(840));
    const Said said = karinui("batch run " + run("run"));
    EXPECT_EQ(said.exit, 3);
    EXPECT_THAT(said.err, HasSubstr("“" + copy + "” is not the design that was planned"));
    EXPECT_THAT(said.err, HasSubstr("Put it back, or plan the batch anew"));
    write(copy, before);
  }
  EXPECT_EQ(karinui("batch run " + run("run") + " --json").json()["hindered"], 0);
  merge("run");
  const std::string table = contents(run("run") + "/table.csv");
  EXPECT_EQ(kept("run"), 2u);
  // An outcome that somebody edited is made again.
  for (const auto& entry : fs::directory_iterator(run("run") + "/items")) {
    std::string item = contents(entry.path().string());
    const auto at = item.find("\"ok\"");
    if (at == std::string::npos) continue;
    write(entry.path().string(), item.replace(at, 4, "\"did not settle\""));
    EXPECT_EQ(karinui("batch merge " + run("run") + " --json").json()["missing"], 1);
    EXPECT_EQ(karinui("batch run " + run("run") + " --json").json()["done"], 1);
  }
  merge("run");
  EXPECT_EQ(contents(run("run") + "/table.csv"), table);
}

TEST_F(Batch, TellsWhatManyProcessorsWouldBring) {
  fs::remove(folder / "designs/loose.karinui");
  fs::create_directory(folder / "scratch");
  const Said said = karinui("batch throughput " + (folder / "designs") + " " + (folder / "people.csv") +
                                " --sample 2 --garments 10000 --cores 300 --json",
                            "C TMPDIR='" + (folder / "scratch") + "'");
  ASSERT_EQ(said.exit, 0) << said.err;
  const auto told = said.json();
  EXPECT_EQ(told["sample"], 2);
  const double garment = told["garment_cpu_s_beside_others"].get<double>();
  EXPECT_GT(garment, 0.01);
  EXPECT_NEAR(told["garments_per_core_hour_beside_others"].get<double>() * garment, 3600, 1e-6);
  const auto model = told["model"], serial = told["serial"];
  const double read = 10 * serial["read_ms_per_garment"].get<double>();
  EXPECT_NEAR(model["garments_s"].get<double>(), read + 34 * garment, 1e-9) << "10,000 on 300 are 34 rounds";
  EXPECT_NEAR(model["plan_s"].get<double>(),
              serial["fixed_s"].get<double>() + 10 * serial["plan_ms_per_garment"].get<double>(), 1e-9);
  EXPECT_NEAR(model["merge_s"].get<double>(), 10 * serial["merge_ms_per_garment"].get<double>(), 1e-9);
  const double all = model["plan_s"].get<double>() + model["garments_s"].get<double>() + model["merge_s"].get<double>();
  EXPECT_NEAR(model["all_s"].get<double>(), all, 1e-9);
  EXPECT_NEAR(model["speedup"].get<double>() * all, all + (10'000 - 34) * garment, 1e-6) << "Amdahl";
  EXPECT_GT(told["bytes_per_garment"]["in"].get<double>(), 500) << "the script, and its own plan";
  EXPECT_LT(told["bytes_per_garment"]["in"].get<double>(), 2000) << "never the manifest";
  EXPECT_GT(told["bytes_per_garment"]["out"].get<double>(), 100);
  // What a garment costs the plan does not depend on how many people the table happens to have.
  write(folder / "two.csv", std::string(kPeople).substr(0, std::string(kPeople).find("giant")));
  const Said fewer = karinui("batch throughput " + (folder / "designs") + " " + (folder / "two.csv") +
                                 " --sample 1 --garments 100 --cores 1 --json",
                             "C TMPDIR='" + (folder / "scratch") + "'");
  const double manifest = told["bytes_per_garment"]["manifest"].get<double>();
  EXPECT_NEAR(fewer.json()["bytes_per_garment"]["manifest"].get<double>(), manifest, 0.05 * manifest);
  // A person is told in words.
  for (const auto& [language, words, well] :
       {std::tuple("C", "100 garments on 4 processors would take:", "on small: ok"),
        std::tuple("ja_JP.UTF-8", "100 着を 4 個のプロセッサーで作ると：", "small：良好")}) {
    const Said spoken = karinui("batch throughput " + (folder / "designs") + " " + (folder / "two.csv") +
                                    " --sample 1 --garments 100 --cores 4",
                                language + (" TMPDIR='" + (folder / "scratch") + "'"));
    EXPECT_THAT(spoken.out, HasSubstr(words));
    EXPECT_THAT(spoken.out, testing::Not(HasSubstr("_"))) << "no name of the JSON";
    EXPECT_THAT(spoken.err, HasSubstr(well));
  }
  const Said one = karinui(
      "batch throughput " + (folder / "designs") + " " + (folder / "two.csv") + " --sample 1 --garments 1 --cores 1",
      "C TMPDIR='" + (folder / "scratch") + "'");
  EXPECT_THAT(one.out, HasSubstr("1 garment on 1 processor would take:"));
  EXPECT_THAT(one.out, HasSubstr("1 time as many"));
  EXPECT_TRUE(fs::is_empty(folder / "scratch"));
}

// A cluster of this one machine, from Debian's slurmctld, slurmd and munge.
class Cluster {
 public:
  explicit Cluster(const std::string& folder) : folder_(folder) { started_ = did("start"); }
  ~Cluster() { did("stop"); }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  bool started() const { return started_; }
  // Ends one of its daemons with no warning and starts it again.
  bool falls(const std::string& daemon) { return did("kill", daemon) && did("start"); }
  // How many jobs of the array wait or run.
  int jobs() const {
    std::FILE* said = ::popen(("SLURM_CONF='" + folder_ + "/slurm.conf' squeue -h -r | wc -l").c_str(), "r");
    int count = -1;
    if (std::fscanf(said, "%d", &count) != 1) count = -1;
    ::pclose(said);
    return count;
  }
  std::string setting() const { return "C SLURM_CONF='" + folder_ + "/slurm.conf'"; }  // for karinui()

 private:
  bool did(const std::string& what, const std::string& daemon = {}) const {
    return std::system(("'" KARINUI_SOURCE "/tests/apps/slurm_here' " + what + " '" + folder_ + "' " + daemon +
                        " </dev/null >/dev/null 2>&1")
                           .c_str()) == 0;
  }
  std::string folder_;
  bool started_ = false;
};

// Two designs on a hundred people; by ./test --long. Each way of doing it is disturbed on the way.
TEST_F(Batch, TwoHundredGarmentsAreTheSameHoweverTheyWereMade) {
  if (const char* asked = std::getenv("KARINUI_LONG"); !asked || !*asked) GTEST_SKIP() << "only by ./test --long";
  std::string people = "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\n";
  for (int i = 0; i < 100; ++i)
    people += "p" + std::to_string(i) + "," + std::to_string(150 + i % 30) + "," + std::to_string(78 + i % 23) + "," +
              std::to_string(60 + i % 21) + "," + std::to_string(86 + i % 19) + "\n";
  write(folder / "people.csv", people);
  const auto atLeast = [&](const std::string& name, std::size_t count) {
    for (int i = 0; i < 60'000 && kept(name) < count; ++i) ::usleep(10'000);
    return kept(name) >= count;
  };
  const auto killOne = [&](const std::vector<std::string>& with) {
    const pid_t pid = waitFor(with);
    return pid != 0 && ::kill(pid, SIGKILL) == 0;
  };
  const auto gone = [&](const std::vector<std::string>& with) {
    for (int i = 0; i < 3000 && !processes(with).empty(); ++i) ::usleep(10'000);
    return processes(with).empty();
  };
  const std::string kRuns("batch\0run\0", 10);  // words of its own, not within a command of the controller
  const auto began = std::chrono::steady_clock::now();
  const auto tell = [&](const char* what) {
    const auto taken = std::chrono::steady_clock::now() - began;
    std::printf("[          ] %s after %ld s\n", what,
                static_cast<long>(std::chrono::duration_cast<std::chrono::seconds>(taken).count()));
    std::fflush(stdout);
  };

  // One process, from the first to the last.
  ASSERT_EQ(plan("serial").json()["items"], 200);
  ASSERT_EQ(karinui("batch run " + run("serial") + " --threads 1").exit, 0);
  merge("serial");
  tell("serial: 200 garments");

  // GNU parallel, or xargs where there is none. Workers are killed, then all of it, and it is begun again.
  ASSERT_EQ(plan("parallel").exit, 0);
  const bool gnu = std::system("parallel --version >/dev/null 2>&1") == 0;
  const std::string shard = "'" KARINUI_COMMAND "' batch run --shard {}/8 --threads 1 '" + run("parallel") + "'";
  const std::string all = "exec " + (gnu ? "parallel --will-cite -j 2 \"" + shard + "\" ::: 1 2 3 4 5 6 7 8"
                                         : "xargs -I{} -P 2 " + shard + " <'" + (folder / "eight") + "'");
  write(folder / "eight", "1\n2\n3\n4\n5\n6\n7\n8\n");
  write(folder / "all.sh", all + " >/dev/null 2>&1\n");
  const std::string start = "sh '" + (folder / "all.sh") + "'";
  ASSERT_EQ(std::system((start + " &").c_str()), 0);
  ASSERT_TRUE(atLeast("parallel", 20));
  EXPECT_TRUE(killOne({"batch", "item", run("parallel")})) << "a worker";
  ASSERT_TRUE(atLeast("parallel", 40));
  EXPECT_TRUE(killOne({kRuns, run("parallel")})) << "a shard";
  ASSERT_TRUE(atLeast("parallel", 60));
  EXPECT_TRUE(killOne({gnu ? "--will-cite" : "-I{}", run("parallel")})) << "the controller";
  for (const pid_t pid : processes({kRuns, run("parallel")})) ::kill(pid, SIGKILL);
  ASSERT_TRUE(gone({run("parallel")}));
  EXPECT_LT(kept("parallel"), 200u);
  ASSERT_EQ(std::system(start.c_str()), 0);
  merge("parallel");
  expectSame("serial", "parallel");
  tell(gnu ? "GNU parallel: 200 garments" : "xargs: 200 garments");

  Cluster cluster(folder / "slurm");
  if (!cluster.started()) GTEST_SKIP() << "Slurm's daemons are not installed here: nothing was submitted";
  ASSERT_EQ(plan("cluster").exit, 0);
  const auto submit = [&] {
    const Said said = karinui("batch submit " + run("cluster") + " --slurm --shards 8 --threads 1", cluster.setting());
    EXPECT_EQ(said.exit, 0) << said.err;
    EXPECT_THAT(said.out, HasSubstr("Submitted as job "));
  };
  submit();
  ASSERT_TRUE(atLeast("cluster", 20));
  EXPECT_TRUE(killOne({"batch", "item", run("cluster")})) << "a worker";
  ASSERT_TRUE(atLeast("cluster", 40));
  EXPECT_TRUE(cluster.falls("slurmctld")) << "the controller";
  ASSERT_TRUE(atLeast("cluster", 60));
  EXPECT_TRUE(cluster.falls("slurmd")) << "a node's daemon";
  ASSERT_TRUE(atLeast("cluster", 80));
  EXPECT_TRUE(killOne({kRuns, run("cluster")})) << "a job";
  for (int i = 0; i < 6000 && cluster.jobs() != 0; ++i) ::usleep(100'000);
  tell("Slurm: the first array has ended");
  EXPECT_LT(kept("cluster"), 200u) << "of the job that was killed";
  submit();
  for (int i = 0; i < 6000 && cluster.jobs() != 0; ++i) ::usleep(100'000);
  merge("cluster");
  expectSame("serial", "cluster");
  tell("Slurm: 200 garments");
}

TEST_F(Batch, IsHandedToSlurm) {
  fs::remove(folder / "designs/loose.karinui");
  write(folder / "people.csv", "height_cm,waist_girth_cm,bust_girth_cm,hip_girth_cm\n158,64,83,91\n152,60,78,85\n");
  ASSERT_EQ(plan("shell").exit, 0);
  ASSERT_EQ(plan("cluster").exit, 0);
  EXPECT_EQ(karinui("batch submit " + run("cluster") + " --slurm --partition 'a b'").exit, 3);
  // Where there is no sbatch the script stays.
  const Said alone = karinui(
      "batch submit " + run("shell") + " --slurm --shards 3 --partition debug --attempts 3 --retry", "C PATH=/nowhere");
  EXPECT_EQ(alone.exit, 3);
  EXPECT_THAT(alone.err, HasSubstr("slurm.sh"));
  const std::string script = contents(run("shell") + "/slurm.sh");
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-3\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --partition=debug\n"));
  EXPECT_THAT(script, HasSubstr("--shard \"$SLURM_ARRAY_TASK_ID/3\""));
  EXPECT_THAT(script, HasSubstr(" --attempts 3 --retry\n"));
  // What a shell makes of the jobs, one number of the array after another.
  for (const char* number : {"1", "2", "3"})
    ASSERT_EQ(std::system(("SLURM_ARRAY_TASK_ID=" + std::string(number) + " bash '" + run("shell") +
                           "/slurm.sh' >/dev/null 2>&1")
                              .c_str()),
              0);
  merge("shell");
  Cluster cluster(folder / "slurm");
  if (!cluster.started()) GTEST_SKIP() << "Slurm's daemons are not installed here: nothing was submitted";
  const Said said =
      karinui("batch submit " + run("cluster") + " --slurm --shards 3 --threads 1 --time 10:00", cluster.setting());
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("Submitted as job "));
  for (int i = 0; i < 6000 && kept("cluster") < 2; ++i) ::usleep(20'000);
  merge("cluster");
  expectSame("shell", "cluster");
}

}  // namespace
}  // namespace karinui::test
