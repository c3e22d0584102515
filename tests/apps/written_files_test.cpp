// What commands write: never over what they read, and under no ending but their own. The command itself is asked which
// of its words name what is written, so that none can be forgotten.
#include <gmock/gmock.h>

#include "apps/command.h"

namespace karinui::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

// One line of a help text under a heading: "-o,--output TEXT (needed)   The PDF file".
struct HelpLine {
  std::string heading, words;
  std::string name() const { return words.substr(0, words.find_first_of(" :")); }
  std::string option() const { return name().substr(name().rfind(',') + 1); }
  bool needed() const { return words.find("(needed)") != std::string::npos; }
};

std::vector<HelpLine> helpLines(const std::string& verb) {
  std::vector<HelpLine> lines;
  std::istringstream text(karinui(verb + " --help").out);
  std::string heading;
  for (std::string line; std::getline(text, line);) {
    if (line.ends_with(":") && !line.starts_with(" ")) heading = line.substr(0, line.size() - 1);
    if (line.empty()) heading.clear();
    if (line.starts_with("  ") && line[2] != ' ' && !heading.empty()) lines.push_back({heading, line.substr(2)});
  }
  return lines;
}

// All commands that do something: "play", "body make" …
std::vector<std::string> commands(const std::string& within = "") {
  std::vector<std::string> all;
  for (const HelpLine& line : helpLines(within)) {
    if (line.heading != "Commands") continue;
    const std::string verb = within.empty() ? line.name() : within + " " + line.name();
    const auto inner = commands(verb);
    all.insert(all.end(), inner.begin(), inner.end());
    if (inner.empty()) all.push_back(verb);
  }
  return all;
}

// A word that can stand for a positional or an option: of several words the first, else the document.
std::string wordFor(const HelpLine& line, const std::string& document) {
  const std::size_t brace = line.words.find('{');
  return brace == std::string::npos ? document
                                    : line.words.substr(brace + 1, line.words.find_first_of(",}", brace) - brace - 1);
}

class WrittenFiles : public testing::Test {
 protected:
  void SetUp() override {
    write(folder / "panel.ops",
          "piece name=panel outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0\"\n");
    ASSERT_EQ(karinui("play " + (folder / "panel.ops") + " -o " + document()).exit, 0);
    fs::create_hard_link(document(), folder / "also.karinui");
    for (const char* ending : {"png", "pdf", "svg", "json", "obj", "ops", "txt", "yaml"})
      fs::create_symlink(document(), folder / (std::string("link.") + ending));
  }
  std::string document() { return folder / "d.karinui"; }
  std::size_t files() {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder / ""), fs::directory_iterator()));
  }
  Folder folder;
};

TEST_F(WrittenFiles, NoCommandWritesOverADocumentOrUnderAStrangeEnding) {
  const std::string before = contents(document());
  const std::size_t many = files();
  int outputs = 0;
  for (const std::string& verb : commands()) {
    const std::vector<HelpLine> lines = helpLines(verb);
    for (const HelpLine& written : lines) {
      const bool output = written.heading == "Writes";
      EXPECT_TRUE(output || !written.name().starts_with("-o")) << verb << ": " << written.words;
      if (!output) continue;
      ++outputs;
      std::string words = verb;
      for (const HelpLine& line : lines) {
        if (line.name() == written.name() ||
            !(line.heading == "Given in order" || line.heading == "Options" || line.heading == "Writes"))
          continue;
        const bool goesWith = written.words.find("Needs: " + line.option()) != std::string::npos;
        if (line.heading == "Given in order" && line.needed()) words += " " + wordFor(line, document());
        if (line.heading != "Given in order" && (line.needed() || goesWith))
          words +=
              " " + line.option() + " " + (line.heading == "Writes" ? folder / "x.karinui" : wordFor(line, document()));
        if (line.option() == "--overwrite") words += " --overwrite";
      }
      std::string endings;  // that are written, as the first name with another one is told
      for (const char* name : {"d.karinui", "also.karinui", "x.jpg", "x.karinui.bak", "link.png", "link.pdf",
                               "link.svg", "link.json", "link.obj", "link.ops", "link.txt", "link.yaml", "noending"}) {
        const bool isFolder =
            written.words.find("folder") != std::string::npos && written.words.find("PNG file") == std::string::npos;
        if (isFolder && !fs::exists(folder / name)) continue;
        const bool link = std::string(name).starts_with("link");
        if (link && words.find(document()) == std::string::npos) continue;  // read by nobody
        if (link && !endings.empty() && endings.find(fs::path(name).extension().string()) == std::string::npos)
          continue;
        const Said said = karinui(words + " " + written.option() + " " + (folder / name));
        EXPECT_THAT(said.exit, AnyOf(2, 3)) << words << " " << written.option() << " " << name << ": " << said.err;
        EXPECT_THAT(said.err, AnyOf(HasSubstr("has none of the endings that are written: ."),
                                    HasSubstr("is read by this command and would be lost"),
                                    HasSubstr("is a file; name a folder"), HasSubstr("--pictures cannot be")))
            << words;
        if (const auto list = said.err.find("that are written: ."); list != std::string::npos)
          endings = said.err.substr(list);
        EXPECT_EQ(contents(document()), before) << words << " " << name;
        EXPECT_EQ(files(), many) << words << " " << name;
      }
    }
  }
  EXPECT_GE(outputs, 18);
}

// A folder that is not there is told before anything is read or worked out: the document is missing, too.
TEST_F(WrittenFiles, AMissingFolderIsToldFirst) {
  const std::string none = folder / "none.karinui", out = folder / "missing/dir/x.";
  for (const std::string& words :
       {"export " + none + " -o " + out + "glb --poses T,A", "picture " + none + " -o " + out + "png",
        "picture " + none + " --table -o " + out + "png", "layout " + none + " -o " + out + "pdf",
        "report " + none + " -o " + out + "pdf", "check " + none + " --poses T --sheet " + out + "png",
        "refit " + none + " --body jis9ar -o " + out + "karinui"}) {
    const Said said = karinui(words);
    EXPECT_NE(said.exit, 0) << words;
    EXPECT_THAT(said.err, HasSubstr("there is no such folder")) << words;
    EXPECT_FALSE(fs::exists(folder / "missing")) << words;
  }
}

TEST_F(WrittenFiles, WhatASheetCannotHoldIsRefusedAndLettersOfEitherCaseAreTaken) {
  const auto exported = [&](const std::string& file, const std::string& more) {
    return karinui("export " + document() + " -o " + (folder / file) + " " + more);
  };
  for (const auto& [file, more, fault] : {std::tuple("x.svg", "--paper a4", "--paper says nothing of “x.svg”"),
                                          {"x.glb", "--allowance 10", "--allowance says nothing of “x.glb”"},
                                          {"x.dxf", "--date today", "--date says nothing of “x.dxf”"},
                                          {"x.json", "--nest", "--nest says nothing of “x.json”"},
                                          {"x.plt", "--overlap 12", "--overlap says nothing of “x.plt”"},
                                          {"x.svg", "--pairs-once", "--pairs-once says nothing of “x.svg”"},
                                          {"x.json", "--format dxf-aama", "“dxf-aama” is no format of x.json"}}) {
    const Said said = exported(file, more);
    EXPECT_EQ(said.exit, 3) << more;
    EXPECT_THAT(said.err, HasSubstr(fault));
    EXPECT_FALSE(fs::exists(folder / file)) << more;
  }
  ASSERT_EQ(exported("small.pdf", "--paper a4").exit, 0);
  ASSERT_EQ(exported("large.pdf", "--paper A4").exit, 0);
  EXPECT_EQ(contents(folder / "small.pdf"), contents(folder / "large.pdf"));
  EXPECT_EQ(exported("x.json", "--format GarmentCode --allowance 10").exit, 3);
  EXPECT_EQ(exported("x.JSON", "--format GarmentCode").exit, 0);
  const Said lay = karinui("layout " + document() + " -o " + (folder / "lay.svg") + " --paper a4");
  EXPECT_EQ(lay.exit, 3);
  EXPECT_THAT(lay.err, HasSubstr("--paper says nothing of “lay.svg”"));
  const Said nest = karinui("picture " + document() + " -o " + (folder / "n.png") + " --nest");
  EXPECT_EQ(nest.exit, 2);
  EXPECT_THAT(nest.err, HasSubstr("--nest goes with --table"));
}

}  // namespace
}  // namespace karinui::test
