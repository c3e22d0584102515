#pragma once
// A batch's manifest and outcomes as text: a folder can come from anyone, so these are a stranger's bytes. Any thread.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "../shallow_json.h"
#include "karinui/base/result.h"
#include "karinui/body/measurements.h"

namespace karinui::app {

struct BatchDesign {
  std::string name;  // of the file it was
  std::string file;  // within the folder
};
struct BatchBody {
  std::string name;
  Measurements measures;
};
struct BatchItem {
  std::string key;
  std::size_t design = 0, body = 0;
  std::string fabric;  // for all pieces; empty: as designed
};
struct BatchPlan {
  std::string build;   // hash of the program
  double spacing = 0;  // metres between the threads; 0: as designed
  std::vector<BatchDesign> designs;
  std::vector<BatchBody> bodies;
  std::vector<BatchItem> items;
};

// The hash of all that an item's outcome depends on.
std::string keyOf(const BatchPlan& plan, const BatchItem& item);

std::string manifestText(const BatchPlan& plan);
// What the text says, whatever the keys are: every item has its design and its body, every design is a plain name in
// designs/. `folder` is said.
Result<BatchPlan> parseManifest(std::string_view bytes, const std::filesystem::path& folder);
// The same, and every key is that of its item.
Result<BatchPlan> parsePlan(std::string_view bytes, const std::filesystem::path& folder);
// A plan of this item alone as text, of a size that does not grow with the batch.
std::string planOf(const BatchPlan& plan, const BatchItem& item);

// The last three tell of the machine rather than of the garment: another time it may go well.
enum class Outcome { Ok, Refused, NotSettled, Timeout, OutOfMemory, Crashed };
const char* nameOf(Outcome outcome);  // "ok", "refused", "did not settle", "timeout", "out of memory", "crashed"

// An outcome as it is written, and read back; null: not one of this item, or not as this program wrote it.
std::string outcomeText(const BatchItem& item, Outcome outcome, const Message& said, Json numbers, int seconds);
Json parseOutcome(std::string_view bytes, const BatchItem& item);
std::string sealOf(Json outcome);          // over all but the seal itself
Message saidOf(const Json& outcome);       // what it was told, to be said in any language
Message outcomeSaid(const Json& outcome);  // its one word of the above

}  // namespace karinui::app
