// Nothing leaves the machine: each verb is run with every socket written down.
#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "apps/command.h"

namespace karinui::test {
namespace {

namespace fs = std::filesystem;

// The verbs that `karinui WORDS --help` lists, each after `words`.
std::set<std::string> verbsOf(const std::string& words) {
  std::set<std::string> verbs;
  std::istringstream help(karinui(words + "--help").out);
  bool among = false;
  for (std::string line; std::getline(help, line);)
    if (line == "Commands:")
      among = true;
    else if (line.empty())
      among = false;
    else if (among && line.starts_with("  ") && line[2] != ' ')
      verbs.insert(words + line.substr(2, line.find(' ', 2) - 2));
  return verbs;
}

class Network : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "A sanitizer wants to be loaded before the watch.";
#endif
  }
  // What the command did with sockets, line by line. `before`: variables, or what is piped into it.
  std::vector<std::string> socketsOf(const std::string& words, const std::string& before = "") {
    const std::string log = folder / "sockets";
    fs::remove(log);
    const std::string command = before + "LC_ALL=C KARINUI_SOCKETS='" + log +
                                "' LD_PRELOAD='" KARINUI_WATCHED_SOCKETS "' '" KARINUI_COMMAND "' " + words + " >'" +
                                (folder / "out") + "' 2>&1";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 4))  // 4: not at rest
        << words << ": " << contents(folder / "out");
    std::vector<std::string> lines;
    std::istringstream all(contents(log));
    for (std::string line; std::getline(all, line);) lines.push_back(line);
    return lines;
  }
  Folder folder;
};

TEST_F(Network, NoVerbOpensASocket) {
  const std::string d = folder / "d.karinui";
  const auto in = [&](const std::string& name) { return " " + (folder / name); };
  const auto to = [&](const std::string& name) { return " -o " + (folder / name); };
  write(
      folder / "d.ops",
      "body size=jis9ar\nset spacing=50mm\npiece name=band outline=\"M 0 0; low L 900 0; right L 900 150; top L 0 150; "
      "left L 0 0\"\nplace piece=band at=\"torso:waist@0\" ease=2cm\nsew a=band.left b=band.right\n");
  write(folder / "people.csv", "name,height_cm,bust_girth_cm,waist_girth_cm,hip_girth_cm\na,158,83,64,91\n");
  write(folder / "hand.txt", "hover space 0 0 0 1 0 0 -1 0 0 1 reach 0.01 tip 0.2 0.2 0.02 1 0 0 0 device stylus\n");
  write(folder / "sbatch", "#!/bin/sh\necho 7\n");
  fs::permissions(folder / "sbatch", fs::perms::owner_all);
  const std::string cluster = "PATH='" + (folder / "") + "':\"$PATH\" ";
  const std::string asked = "echo '{\"id\":1,\"do\":\"open\",\"file\":\"" + d + "\"}' | ";
  struct Call {
    std::string verb, rest, before = "";
  };
  std::set<std::string> called;
  for (const Call& call : std::vector<Call>{
           {"play", in("d.ops") + " -o " + d},
           {"info", " " + d},
           {"check", " " + d},
           {"do", " " + d + " 'drape stop=3'"},
           {"settle", " " + d},
           {"undo", " " + d},
           {"redo", " " + d},
           {"amend", " " + d + " 1 'body size=eu38'"},
           {"log", " " + d},
           {"variables", " " + d},
           {"truing", " " + d},
           {"sizes", " " + d},
           {"export", " " + d + to("d.pdf")},
           {"export", " " + d + to("d.svg")},
           {"export", " " + d + to("d.glb")},
           {"export", " " + d + to("d.dxf")},
           {"picture", " " + d + to("d.png") + " --size 100x100"},
           {"picture", " " + d + to("t.png") + " --table"},
           {"layout", " " + d + to("layout.pdf")},
           {"report", " " + d + to("report.pdf") + " --no-pictures"},
           {"share", " " + d + to("shared.karinui")},
           {"dump", " " + d + to("d.txt")},
           {"load", in("d.txt") + to("loaded.karinui")},
           {"rescue", " " + d + to("rescued.karinui")},
           {"refit", " " + d + " --body eu38" + to("refitted.karinui")},
           {"import", in("d.dxf") + to("imported.karinui")},
           {"body make", " --size jis9ar" + to("body.obj")},
           {"body measure", in("body.obj")},
           {"body sizes", ""},
           {"fabric measure", " --swatch 100x100 --mass 1.5"},
           {"serve", "", asked},
           {"batch plan", in("d.ops") + in("people.csv") + to("batch")},
           {"batch submit", in("batch") + " --slurm", cluster},
           {"batch run", in("batch") + " --jobs 1"},
           {"batch merge", in("batch")},
           {"batch report", in("batch") + to("fit.pdf")},
           {"batch picture", in("batch") + to("people.png") + " --size 60x100"},
           {"batch throughput", in("d.ops") + in("people.csv") + " --sample 1 --garments 10 --cores 2"},
           {"bench", " w3 --vertices 200"},
           {"touch replay", in("hand.txt") + " " + d},
       }) {
    EXPECT_THAT(socketsOf(call.verb + call.rest, call.before), testing::IsEmpty()) << call.verb << call.rest;
    called.insert(call.verb);
  }
  std::set<std::string> verbs;
  for (const std::string& verb : verbsOf(""))
    if (const auto own = verbsOf(verb + " "); own.empty())
      verbs.insert(verb);
    else
      verbs.insert(own.begin(), own.end());
  EXPECT_EQ(verbs.erase("touch check"), 1u) << "below";
  EXPECT_EQ(called, verbs) << "each verb, once at least";
}

// That proves the watch too: devices are asked for on this machine, and nowhere else.
TEST_F(Network, DevicesAreAskedForOnThisMachineOnly) {
  const auto seen = socketsOf("touch check --seconds 0.1");
  EXPECT_THAT(seen, testing::Contains("connect inet 127.0.0.1"));
  for (const std::string& line : seen)
    EXPECT_THAT(line, testing::AnyOf("socket inet", "socket unix", "connect inet 127.0.0.1",
                                     testing::StartsWith("connect unix /"), "bind inet 127.0.0.1"));
}

}  // namespace
}  // namespace karinui::test
