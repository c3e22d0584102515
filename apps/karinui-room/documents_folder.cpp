#include "documents_folder.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace karinui::room {

std::filesystem::path documentsFolder() {
  const char* home = std::getenv("HOME");
  if (!home || !*home) return {};
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const std::filesystem::path named =
      (config && *config ? std::filesystem::path(config) : std::filesystem::path(home) / ".config") / "user-dirs.dirs";
  std::filesystem::path documents = std::filesystem::path(home) / "Documents";
  // XDG_DOCUMENTS_DIR="$HOME/Documents", by xdg-user-dirs: the folder may be called in the person's language.
  std::ifstream file(named);
  for (std::string line; std::getline(file, line);) {
    const std::string key = "XDG_DOCUMENTS_DIR=\"";
    if (!line.starts_with(key) || line.size() < key.size() + 2 || line.back() != '"') continue;
    std::string value = line.substr(key.size(), line.size() - key.size() - 1);
    if (value.starts_with("$HOME/")) value = std::string(home) + value.substr(5);
    if (value.starts_with("/")) documents = value;
  }
  return documents / "Karinui";
}

}  // namespace karinui::room
