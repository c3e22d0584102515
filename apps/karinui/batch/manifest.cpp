#include "manifest.h"

#include <algorithm>

#include "karinui/base/file.h"
#include "karinui/base/hash.h"
#include "karinui/base/number.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

constexpr int kForm = 1;
constexpr const char* kOutcomes[] = {"ok", "refused", "did not settle", "timeout", "out of memory", "crashed"};

// A file's name need not be UTF-8.
std::string textOf(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string measuresText(const Measurements& measures) {
  std::string all(sexName(measures.sex));
  for (const auto& [key, value] : measures.value) all += "; " + key + "=" + shortest(value);
  return all;
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

Error changedByHand(const fs::path& folder) {
  return badInput(say("The manifest in “{0}” was changed by hand; plan the batch anew.", folder.string()));
}

// Members of a manifest; each throws what Json throws, where there is none of its kind.
std::string words(const Json& object, const char* name) { return object.at(name).get<std::string>(); }
std::size_t index(const Json& object, const char* name) {
  const Json& value = object.at(name);
  return value.is_number_unsigned() ? value.get<std::size_t>() : ~std::size_t{0};
}

bool plainDesign(const std::string& file) {
  constexpr std::string_view kFolder = "designs/";
  return file.starts_with(kFolder) && isPlainName(std::string_view(file).substr(kFolder.size()));
}

}  // namespace

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

std::string manifestText(const BatchPlan& plan) { return textOf(manifestOf(plan), 1) + "\n"; }

std::string planOf(const BatchPlan& plan, const BatchItem& item) {
  BatchPlan one{plan.build, plan.spacing, {plan.designs[item.design]}, {plan.bodies[item.body]}, {item}};
  one.items.front().design = one.items.front().body = 0;
  return textOf(manifestOf(one), -1);
}

Result<BatchPlan> parseManifest(std::string_view bytes, const fs::path& folder) {
  const auto manifest = shallowJson(bytes);
  if (!manifest || !manifest->is_object()) return noPlan(folder);
  BatchPlan plan;
  try {
    if (manifest->at("karinui_batch") != kForm) return noPlan(folder);
    plan.build = words(*manifest, "build");
    plan.spacing = manifest->at("spacing_m").get<double>();
    for (const Json& design : manifest->at("designs"))
      plan.designs.push_back({words(design, "name"), words(design, "file")});
    for (const Json& body : manifest->at("bodies")) {
      BatchBody& one = plan.bodies.emplace_back();
      one.name = words(body, "name");
      const auto sex = sexNamed(words(body, "sex"));
      if (!sex || !body.at("measures").is_object()) return noPlan(folder);
      one.measures.sex = *sex;
      for (const auto& [key, value] : body.at("measures").items()) one.measures.value[key] = value.get<double>();
    }
    for (const Json& item : manifest->at("items"))
      plan.items.push_back({words(item, "key"), index(item, "design"), index(item, "body"), words(item, "fabric")});
  } catch (const Json::exception&) {
    return noPlan(folder);
  }
  for (const BatchDesign& design : plan.designs)
    if (!plainDesign(design.file)) return noPlan(folder);
  for (const BatchItem& item : plan.items)
    if (item.design >= plan.designs.size() || item.body >= plan.bodies.size()) return changedByHand(folder);
  return plan;
}

Result<BatchPlan> parsePlan(std::string_view bytes, const fs::path& folder) {
  auto plan = parseManifest(bytes, folder);
  if (!plan) return plan;
  for (const BatchItem& item : plan->items)
    if (item.key != keyOf(*plan, item)) return changedByHand(folder);
  return plan;
}

const char* nameOf(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }

std::string outcomeText(const BatchItem& item, Outcome outcome, const Message& said, Json numbers, int seconds) {
  Json object = {{"key", item.key},
                 {"outcome", nameOf(outcome)},
                 {"said", text(said)},
                 {"sentence", sentenceJson(said)},
                 {"numbers", std::move(numbers)}};
  if (seconds > 0) object["seconds"] = seconds;
  object["seal"] = sealOf(object);
  return textOf(object, 1) + "\n";
}

Json parseOutcome(std::string_view bytes, const BatchItem& item) {
  auto object = shallowJson(bytes);
  if (!object || !object->is_object()) return Json();
  const Json word = object->value("outcome", Json());
  const bool known =
      std::any_of(std::begin(kOutcomes), std::end(kOutcomes), [&](const char* one) { return word == one; });
  const bool whole = known && object->value("key", Json()) == item.key && object->value("said", Json()).is_string() &&
                     object->value("numbers", Json()).is_object() && object->value("seal", Json()) == sealOf(*object);
  return whole ? *std::move(object) : Json();
}

std::string sealOf(Json outcome) {
  outcome.erase("seal");
  return Hasher().add(std::string_view(textOf(outcome, -1))).hex();
}

Message saidOf(const Json& outcome) {
  if (auto sentence = sentenceOf(outcome.value("sentence", Json()))) return *std::move(sentence);
  return say("{0}", outcome.at("said").get<std::string>());
}

Message outcomeSaid(const Json& outcome) {
  const Message all[] = {say("ok"),      say("refused"),       say("did not settle"),
                         say("timeout"), say("out of memory"), say("crashed")};
  static_assert(std::size(all) == std::size(kOutcomes));
  const std::string word = outcome.at("outcome").get<std::string>();
  const auto* known = std::find(std::begin(kOutcomes), std::end(kOutcomes), word);
  KARINUI_ASSERT(known != std::end(kOutcomes));
  return all[known - std::begin(kOutcomes)];
}

}  // namespace karinui::app
