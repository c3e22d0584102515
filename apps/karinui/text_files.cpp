#include "text_files.h"

#include <filesystem>

#include "karinui/design/script.h"

namespace karinui::app {

namespace {

// A name as it is typed on the command line.
std::string typed(const std::string& path) {
  return path.find_first_of(" \t'\"") == std::string::npos ? path : "'" + path + "'";
}

}  // namespace

bool isScript(std::string_view text) {
  const auto lines = parseScript(text);
  return lines && !lines->empty();
}

Error readByPlay(const std::string& path) {
  return badInput(
      say("“{0}” holds operations, as “karinui log” writes them; this makes the document of them: karinui "
          "play {1} -o NAME.karinui",
          std::filesystem::path(path).filename().string(), typed(path)));
}

Error readByLoad(const std::string& path) {
  return badInput(
      say("“{0}” holds a whole document, as “karinui dump” writes it; this makes the document of it: "
          "karinui load {1} -o NAME.karinui",
          std::filesystem::path(path).filename().string(), typed(path)));
}

}  // namespace karinui::app
