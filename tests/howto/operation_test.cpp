// docs/develop/howto.md, An operation: how many files have to name one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "karinui/design/script.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

struct Naming {
  std::string type, name;  // FlipSeam, "flip"
};

// The source and data files that name an operation's struct, its word, or, in the catalogue, its help.
std::set<std::string> filesNaming(const Naming& operation) {
  const std::regex type("(^|[^:\\w]|[^d]::)" + operation.type + "\\b");  // not Command::FlipSeam, which is a key
  std::string help;
  for (const OperationHelp& one : operationHelp())
    if (one.name == operation.name) help = one.help;
  EXPECT_NE(help, "");
  std::set<std::string> files;
  const fs::path root = KARINUI_SOURCE_DIR;
  for (const char* folder : {"include", "src", "apps", "data"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string ending = entry.path().extension();
      if (ending != ".h" && ending != ".cpp" && ending != ".tsv") continue;
      const std::string text = content(entry.path());
      const bool names = std::regex_search(text, type) || text.find('"' + operation.name + '"') != std::string::npos ||
                         (ending == ".tsv" && text.find(help) != std::string::npos);
      if (names) files.insert(fs::relative(entry.path(), root));
    }
  return files;
}

TEST(HowToAddAnOperation, FiveFilesMakeItAPartOfScriptsDocumentsHelpAndSteps) {
  std::set<std::string> files = filesNaming({"FlipSeam", "flip"});
  // A tool of the studio, with a key and a menu entry, is wanted for some operations and comes on top.
  std::erase_if(files, [](const std::string& file) {
    return file.starts_with("src/session/") || file.starts_with("include/karinui/session/");
  });
  EXPECT_THAT(files,
              testing::UnorderedElementsAre("include/karinui/design/operations/sewing.h",
                                            "src/design/operations/operations.h", "src/design/operations/flip.cpp",
                                            "src/design/glossary/step_terms.cpp", "data/messages.ja.tsv"));
}

TEST(HowToAddAnOperation, NothingElseButItsDialogNamesOneThatHasNoTool) {
  std::set<std::string> files = filesNaming({"ChangeSettings", "set"});
  // Sharing and batches make garments anew, and perform it.
  std::erase_if(files, [](const std::string& file) {
    return file.starts_with("apps/karinui-studio/") || file == "src/design/share.cpp" ||
           file.starts_with("apps/karinui/batch/");
  });
  EXPECT_LE(files.size(), 5u);
}

}  // namespace
}  // namespace karinui
