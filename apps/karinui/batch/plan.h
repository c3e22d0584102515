#pragma once
// What a batch is: every design on every body, in every fabric that is asked for. It lies in a folder, with copies of
// the designs, so that the folder is all that a machine needs:
//   manifest.json   what is to be done; an item's key is the hash of all its outcome depends on
//   designs/        the documents and scripts, by their hash
//   items/KEY.json  what became of an item: written whole or not at all, and the only truth; sealed with its hash
//   garments/       the garments of pictures, by key: made again at need, and lost without harm
#include <filesystem>
#include <string>
#include <vector>

#include "../console.h"
#include "karinui/design/history.h"
#include "karinui/exchange/measurement_table.h"
#include "manifest.h"

namespace karinui::app {

// What a copy of a design is named by: the hash of a script's bytes, or of a document's steps up to its head, whatever
// else lies in the file.
std::string designHash(const std::string& script);
std::string designHash(const DocumentFile& document);
constexpr const char *kScriptCopy = ".ops", *kDocumentCopy = ".karinui";

struct BatchWish {
  std::filesystem::path designs;  // a document, a script, or a folder of them
  std::filesystem::path bodies;   // a table of measures
  std::filesystem::path folder;
  std::vector<std::string> fabrics;
  double spacing = 0;
};

// Makes the folder, for its owner alone. One that holds the same plan already is left as it is, with what was done;
// another is refused.
Result<BatchPlan> planBatch(const BatchWish& wish, const Console& console);
// The same for people that were read already; the wish's table is not.
Result<BatchPlan> planBatch(const BatchWish& wish, const std::vector<MeasuredPerson>& people);
// Refuses what is no plan of this form.
Result<BatchPlan> readPlan(const std::filesystem::path& folder);
// A batch that another build of the program planned would give other results under the same keys.
Done madeByThisProgram(const BatchPlan& plan);

// Within a batch, full of people's measures: mode 0700. One that is there keeps its own.
Done makePrivateFolder(const std::filesystem::path& folder);
std::filesystem::path itemFile(const std::filesystem::path& folder, const BatchItem& item);

// What became of an item; null: not known yet, or the file is not as it was written.
Json itemOutcome(const std::filesystem::path& folder, const BatchItem& item);
Done keepOutcome(const std::filesystem::path& folder, const BatchItem& item, Outcome outcome, const Message& said,
                 Json numbers = Json::object(), int seconds = 0);  // seconds: those that were not enough

}  // namespace karinui::app
