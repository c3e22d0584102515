#pragma once
// bench wardrobe: every garment of a folder, drafted, draped and examined.
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"

namespace karinui::app {

struct WardrobeOptions {
  std::filesystem::path folder;
  std::vector<std::string> only;  // names; empty: all
  double seconds = 60;            // of processor time for each
  int threads = 1;
  bool continued = false;
};
// Answers with a table, or one JSON object; progress on stderr. Not settled: one that is not at rest in its time.
int benchWardrobe(Program& program, const WardrobeOptions& options);

}  // namespace karinui::app
