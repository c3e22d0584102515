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

constexpr int kForm = 1;
constexpr std::size_t kMostItems = 1'000'000, kLongestPlan = std::size_t{1} << 30;

std::string hashOf(std::string_view bytes) { return Hasher().add(bytes).hex(); }

// The program's own bytes: two that differ may give different results.
Result<std::string> thisBuild() {
  const auto bytes = readFile("/proc/self/exe", std::size_t{2} << 30);
  if (!bytes) return bytes.error();
  return hashOf(*bytes);
}

std::string measuresText(const Measurements& measures) {
  std::string all(sexName(measures.sex));
  for (const auto& [key, value] : measures.value) all += "; " + key + "=" + shortest(value);
  return all;
}

std::string keyOf(const BatchPlan& plan, const BatchItem& item) {
  const BatchDesign& design = plan.designs[item.design];
  return Hasher()
      .add(std::string_view(plan.build))
      .add(plan.spacing)
      .add(std::string_view(design.file))
      .add(std::string_view(measuresText(plan.bodies[item.body].measures)))
      .add(std::string_view(item.fabric))
      .hex();
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

// A sentence with its values, so that it can be said in another language later.
Json sentenceJson(const Message& said) {
  Json values = Json::array();
  for (const Message::Value& value : said.values)
    if (const auto* inner = std::get_if<Message>(&value))
      values.push_back(sentenceJson(*inner));
    else
      values.push_back(std::get<std::string>(value));
  return {{"pattern", said.pattern}, {"values", std::move(values)}};
}
std::optional<Message> sentenceOf(const Json& object, int depth = 0) {
  constexpr int kDeepest = 8;
  constexpr std::size_t kMostValues = 10;
  if (depth > kDeepest || !object.is_object() || !object.value("pattern", Json()).is_string()) return std::nullopt;
  const Json values = object.value("values", Json());
  if (!values.is_array() || values.size() > kMostValues) return std::nullopt;
  Message said{object.at("pattern").get<std::string>(), {}};
  for (const Json& value : values) {
    if (value.is_string()) {
      said.values.emplace_back(value.get<std::string>());
    } else if (auto inner = sentenceOf(value, depth + 1)) {
      said.values.emplace_back(*std::move(inner));
    } else {
      return std::nullopt;
    }
  }
  return said;
}

Json manifestOf(const BatchPlan& plan) {
  Json designs = Json::array(), bodies = Json::array(), items = Json::array();
  for (const BatchDesign& design : plan.designs) designs.push_back({{"name", design.name}, {"file", design.file}});
  for (const BatchBody& body : plan.bodies) {
    Json measures = Json::object();
    for (const auto& [key, value] : body.measures.value) measures[key] = value;
    bodies.push_back({{"name", body.name}, {"sex", sexName(body.measures.sex)}, {"measures", measures}});
  }
  for (const BatchItem& item : plan.items)
    items.push_back({{"key", item.key}, {"design", item.design}, {"body", item.body}, {"fabric", item.fabric}});
  return {{"karinui_batch", kForm}, {"build", plan.build}, {"spacing_m", plan.spacing},
          {"designs", designs},     {"bodies", bodies},    {"items", items}};
}

Error noPlan(const fs::path& folder) {
  return badInput(
      say("“{0}” holds no batch that this program can read; plan it with karinui batch plan.", folder.string()));
}

// Of an outcome, over all but the seal itself: by it one sees that nothing but this program wrote it.
std::string sealOf(Json outcome) {
  outcome.erase("seal");
  return hashOf(outcome.dump(-1, ' ', false, Json::error_handler_t::replace));
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
  const std::string manifest = manifestOf(plan).dump(1) + "\n";
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
  return bytes ? parsePlan(*bytes, folder) : noPlan(folder);
}

std::string planOf(const BatchPlan& plan, const BatchItem& item) {
  BatchPlan one{plan.build, plan.spacing, {plan.designs[item.design]}, {plan.bodies[item.body]}, {item}};
  one.items.front().design = one.items.front().body = 0;
  return manifestOf(one).dump();
}

Result<BatchPlan> parsePlan(const std::string& bytes, const fs::path& folder) {
  BatchPlan plan;
  try {
    const Json manifest = Json::parse(bytes);
    if (manifest.at("karinui_batch") != kForm) return noPlan(folder);
    plan.build = manifest.at("build").get<std::string>();
    plan.spacing = manifest.at("spacing_m").get<double>();
    for (const Json& design : manifest.at("designs"))
      plan.designs.push_back({design.at("name").get<std::string>(), design.at("file").get<std::string>()});
    for (const Json& body : manifest.at("bodies")) {
      BatchBody& one = plan.bodies.emplace_back();
      one.name = body.at("name").get<std::string>();
      one.measures.sex = sexNamed(body.at("sex").get<std::string>()).value_or(Sex::Female);
      for (const auto& [key, value] : body.at("measures").items()) one.measures.value[key] = value.get<double>();
    }
    for (const Json& item : manifest.at("items"))
      plan.items.push_back({item.at("key").get<std::string>(), item.at("design").get<std::size_t>(),
                            item.at("body").get<std::size_t>(), item.at("fabric").get<std::string>()});
  } catch (const Json::exception&) {
    return noPlan(folder);
  }
  for (const BatchDesign& design : plan.designs)
    if (fs::path(design.file).parent_path() != "designs") return noPlan(folder);
  for (const BatchItem& item : plan.items)
    if (item.design >= plan.designs.size() || item.body >= plan.bodies.size() || item.key != keyOf(plan, item))
      return badInput(say("The manifest in “{0}” was changed by hand; plan the batch anew.", folder.string()));
  return plan;
}

Done madeByThisProgram(const BatchPlan& plan) {
  const auto build = thisBuild();
  if (!build) return build.error();
  if (*build == plan.build) return {};
  return refused(say("Another build of Karinui planned this batch; plan it anew, or run it with that one."));
}

const char* nameOf(Outcome outcome) {
  constexpr const char* kNames[] = {"ok", "refused", "did not settle", "timeout", "out of memory", "crashed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

Json itemOutcome(const fs::path& folder, const BatchItem& item) {
  const auto bytes = readFile(itemFile(folder, item));
  Json object = bytes ? Json::parse(*bytes, nullptr, false) : Json();
  const bool whole = object.is_object() && object.value("key", Json()) == item.key &&
                     object.value("outcome", Json()).is_string() && object.value("said", Json()).is_string() &&
                     object.value("numbers", Json()).is_object() && object.value("seal", Json()) == sealOf(object);
  return whole ? object : Json();
}

Done keepOutcome(const fs::path& folder, const BatchItem& item, Outcome outcome, const Message& said, Json numbers,
                 int seconds) {
  Json object = {{"key", item.key},
                 {"outcome", nameOf(outcome)},
                 {"said", text(said)},
                 {"sentence", sentenceJson(said)},
                 {"numbers", std::move(numbers)}};
  if (seconds > 0) object["seconds"] = seconds;
  object["seal"] = sealOf(object);
  return writeFile(itemFile(folder, item), object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n",
                   Readers::Owner);
}

Message saidOf(const Json& outcome) {
  if (auto sentence = sentenceOf(outcome.value("sentence", Json()))) return *std::move(sentence);
  return say("{0}", outcome.at("said").get<std::string>());
}

}  // namespace karinui::app
