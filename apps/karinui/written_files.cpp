#include "written_files.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "karinui/exchange/formats.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

// By whatever name and link it is reached.
bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code trouble;
  return fs::equivalent(a, b, trouble) && !trouble;
}

}  // namespace

Done mayWrite(const std::string& file, const std::vector<std::string>& endings, const std::vector<std::string>& read) {
  if (std::find(endings.begin(), endings.end(), endingOf(file)) == endings.end())
    return badInput(say("“{0}” has none of the endings that are written: {1}.", fs::path(file).filename().string(),
                        listed(endings)));
  // Asked before the work is done, which may take minutes.
  const fs::path folder = fs::path(file).parent_path();
  std::error_code trouble;
  if (!folder.empty() && !fs::is_directory(folder, trouble))
    return storageError(say("\"{0}\" cannot be written: there is no such folder. Make it first.", file));
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    return storageError(say("\"{0}\" cannot be written: this place is read-only for you. Choose another.", file));
  for (const std::string& word : read) {
    const std::size_t is = word.find('=');
    if (sameFile(word, file) || (is != std::string::npos && sameFile(word.substr(is + 1), file)))
      return refused(say("“{0}” is read by this command and would be lost; write to another name.", file));
  }
  return {};
}

Error unasked(const char* option, const std::string& file) {
  return badInput(say("{0} says nothing of “{1}”; leave it out, or choose another ending.", option,
                      fs::path(file).filename().string()));
}

Done mayBeFolder(const std::string& folder) {
  std::error_code trouble;
  if (!fs::exists(folder, trouble) || fs::is_directory(folder, trouble)) return {};
  return refused(say("“{0}” is a file; name a folder.", folder));
}

Done Program::outputsNamed(const CLI::App& verb) const {
  for (const Output& output : outputs_) {
    if (output.verb != &verb || output.option->count() == 0) continue;
    std::vector<std::string> read;
    for (const CLI::Option* other : verb.get_options())
      if (other != output.option) read.insert(read.end(), other->results().begin(), other->results().end());
    const std::string& named = output.option->results().back();
    const bool folder = output.folder && output.folder->count() > 0;
    if (Done may = folder ? mayBeFolder(named) : mayWrite(named, output.endings, read); !may) return may;
  }
  return {};
}

}  // namespace karinui::app
