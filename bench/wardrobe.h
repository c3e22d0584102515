#pragma once
// A wardrobe: a folder of operation scripts, each of which drafts a garment. Every garment is drafted, draped and
// examined, and none may take longer than it is given. Reads files; any thread, one garment at a time.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/design/drape.h"

namespace karinui::bench {

// The scripts (.ops) of a folder by name. NotFound: no such folder, or none in it.
Result<std::vector<std::filesystem::path>> scriptsIn(const std::filesystem::path& folder);

struct WardrobeSettings {
  double seconds = 60;     // of processor time for drafting and draping one garment; then it is stopped as it stands
  bool continued = false;  // whether its rest is measured as well (Continuation), which is not counted
};

struct WardrobeGarment {
  std::string name;                // of the script
  std::optional<Message> refused;  // why it could not be drafted or draped; nothing else is known then
  bool settled = false;            // in time, and not dirty
  bool outOfTime = false;
  int drapes = 0;           // the script's own, and one at the end where something was not at rest
  std::size_t steps = 0;    // of all drapes
  double cpuSeconds = 0;    // of all drapes,
  double draftSeconds = 0;  // and of drafting: figure, pieces, seams
  SettleReport report;      // of the last drape
  Examination check;        // of where the cloth stands
};

// Cancelled where the token is.
Result<WardrobeGarment> drapeScript(const std::filesystem::path& script, const WardrobeSettings& settings,
                                    Workers& workers, const Token& token);

}  // namespace karinui::bench
