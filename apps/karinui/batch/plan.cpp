#include "plan.h"

#include <algorithm>
#include <set>

#include "karinui/base/file.h"
#include "karinui/base/hash.h"
#include "karinui/base/number.h"
#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "karinui/exchange/formats.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostItems = 1'000'000, kLongestPlan = std::size_t{1} << 30,
                      kLongestOutcome = std::size_t{1} << 20;

std::string hashOf(std::string_view bytes) { return Hasher().add(bytes).hex(); }

// The program's own bytes: two that differ may give different results.
Result<std::string> thisBuild() {
  const auto bytes = readFile("/proc/self/exe", std::size_t{2} << 30);
  if (!bytes) return bytes.error();
  return hashOf(*bytes);
}

bool isDesign(const fs::path& path) {
  const FileContent content = contentOf(path);
  return content == FileContent::Document || content == FileContent::Script;
}

Result<std::vector<fs::path>> designsIn(const fs::path& path) {
  std::error_code trouble;
  if (!fs::exists(path, trouble)) return notFound(say("There is no file “{0}”.", path.string()));
  if (!fs::is_directory(path, trouble)) {
    if (isDesign(path)) return std::vector{path};
    return unreadable(path, {FileContent::Document, FileContent::Script});
  }
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path, trouble))
    if (entry.is_regular_file(trouble) && isDesign(entry.path())) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.empty()) return notFound(say("There is no document or script in “{0}”.", path.string()));
  return found;
}

// The design as it is copied into the batch: refused where it cannot be read.
struct Design {
  std::string hash, ending, bytes;
};
Result<Design> designOf(const fs::path& path) {
  const bool document = contentOf(path) == FileContent::Document;
  auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  Design design{designHash(*bytes), document ? kDocumentCopy : kScriptCopy, *std::move(bytes)};
  if (document) {
    const auto file = DocumentFile::openForReading(path);
    if (!file) return file.error();
    if (file->steps().empty())
      return refused(say("“{0}” is empty; there is nothing to fit.", path.filename().string()));
    design.hash = designHash(*file);
  } else if (const auto script = parseScript(design.bytes); !script) {
    return inFile(path, script.error());
  }
  return design;
}

}  // namespace

std::string designHash(const std::string& script) { return hashOf(script); }
std::string designHash(const DocumentFile& document) {
  const std::vector<Step> steps = document.steps();
  return steps.empty() ? std::string() : steps.back().chain;
}

Done makePrivateFolder(const fs::path& folder) {
  std::error_code trouble;
  if (fs::create_directories(folder, trouble)) fs::permissions(folder, fs::perms::owner_all, trouble);
  if (trouble) return storageError(say("“{0}” could not be written: {1}", folder.string(), trouble.message()));
  return {};
}

fs::path itemFile(const fs::path& folder, const BatchItem& item) { return folder / "items" / (item.key + ".json"); }

Result<BatchPlan> planBatch(const BatchWish& wish, const Console& console) {
  if (const auto paths = designsIn(wish.designs); !paths) return paths.error();
  const auto table = readFile(wish.bodies);
  if (!table) return table.error();
  const auto people = readMeasurementTable(*table);
  if (!people) return inFile(wish.bodies, people.error());
  for (const std::string& column : people->unknown)
    console.note(say("“{0}” has no counterpart here and is left out.", column));
  return planBatch(wish, people->people);
}

Result<BatchPlan> planBatch(const BatchWish& wish, const std::vector<MeasuredPerson>& people) {
  const auto paths = designsIn(wish.designs);
  if (!paths) return paths.error();
  BatchPlan plan;
  const auto build = thisBuild();
  if (!build) return build.error();
  plan.build = *build;
  plan.spacing = wish.spacing;
  for (const MeasuredPerson& person : people) plan.bodies.push_back({person.name, forMannequin(person.measures)});
  std::vector<Design> designs;
  for (const fs::path& path : *paths) {
    auto design = designOf(path);
    if (!design) return design.error();
    plan.designs.push_back({path.stem().string(), "designs/" + design->hash + design->ending});
    designs.push_back(*std::move(design));
  }
  const std::vector<std::string> fabrics = wish.fabrics.empty() ? std::vector<std::string>{""} : wish.fabrics;
  if (plan.designs.size() * plan.bodies.size() * fabrics.size() > kMostItems)
    return refused(say("A batch has {0} items at most; split the table.", kMostItems));
  std::set<std::string> keys;
  for (std::size_t d = 0; d < plan.designs.size(); ++d)
    for (std::size_t b = 0; b < plan.bodies.size(); ++b)
      for (const std::string& fabric : fabrics) {
        BatchItem item{{}, d, b, fabric};
        item.key = keyOf(plan, item);
        if (keys.insert(item.key).second) plan.items.push_back(std::move(item));  // two of the same are done once
      }
  const std::string manifest = manifestText(plan);
  std::error_code trouble;
  const fs::path file = wish.folder / "manifest.json";
  if (fs::exists(file, trouble)) {
    const auto old = readFile(file);
    if (old && *old == manifest) return plan;
    return refused(say("“{0}” holds another batch; choose another folder.", wish.folder.string()));
  }
  for (const fs::path& made : {wish.folder, wish.folder / "designs", wish.folder / "items"})
    if (const Done done = makePrivateFolder(made); !done) return done.error();
  for (std::size_t d = 0; d < designs.size(); ++d)
    if (const Done done = writeFile(wish.folder / plan.designs[d].file, designs[d].bytes, Readers::Owner); !done)
      return done.error();
  if (const Done done = writeFile(file, manifest, Readers::Owner); !done) return done.error();
  return plan;
}

Result<BatchPlan> readPlan(const fs::path& folder) {
  const auto bytes = readFile(folder / "manifest.json", kLongestPlan);
  return parsePlan(bytes ? *bytes : std::string(), folder);
}

Done madeByThisProgram(const BatchPlan& plan) {
  const auto build = thisBuild();
  if (!build) return build.error();
  if (*build == plan.build) return {};
  return refused(say("Another build of Karinui planned this batch; plan it anew, or run it with that one."));
}

Json itemOutcome(const fs::path& folder, const BatchItem& item) {
  const auto bytes = readFile(itemFile(folder, item), kLongestOutcome);
  return bytes ? parseOutcome(*bytes, item) : Json();
}

Done keepOutcome(const fs::path& folder, const BatchItem& item, Outcome outcome, const Message& said, Json numbers,
                 int seconds) {
  return writeFile(itemFile(folder, item), outcomeText(item, outcome, said, std::move(numbers), seconds),
                   Readers::Owner);
}

}  // namespace karinui::app
