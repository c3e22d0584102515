// Measurement files read.
#include <algorithm>
#include <map>
#include <numbers>

#include "exchange/measure_names.h"
#include "exchange/strict_json.h"
#include "exchange/xml.h"
#include "karinui/base/number.h"
#include "karinui/design/formula.h"
#include "karinui/design/script.h"
#include "karinui/exchange/measurement_files.h"

namespace karinui {

namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20, kMostEntries = 5000;
constexpr std::size_t kLongestName = 200;  // of a section or a measure; what follows is not kept

Error notMeasures() { return badInput(say("There are no measures in this file.")); }
Error tooLarge() { return badInput(say("This file is too large for a file of measures.")); }
Error tooMany() { return badInput(say("The file has more than {0} measures.", kMostEntries)); }

std::vector<std::string_view> linesOf(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    lines.push_back(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return lines;
}

// A measure of the given size of its unit; angles are in degrees in every one of these files.
void take(MeasuresRead& into, MeasureSystem system, const std::string& name, double number, double metresPerUnit) {
  const std::string_view key = measureKeyIn(system, name);
  if (key.empty() || !(number > 0)) return into.unknown.push_back(shown(name));
  into.measures.value[std::string(key)] = isAngle(key) ? number * std::numbers::pi / 180 : number * metresPerUnit;
}

Result<MeasuresRead> unlessEmpty(MeasuresRead read) {
  if (read.measures.value.empty()) return notMeasures();
  return read;
}

// A number with a comma for its point, as a person types it who writes in German or French.
std::string withDecimalPoint(std::string value) {
  const std::size_t comma = value.find(',');
  const bool plain = comma != std::string::npos && comma + 1 < value.size() &&
                     value.find_first_not_of("0123456789 ", 0) == comma &&
                     value.find_first_not_of("0123456789 ", comma + 1) == std::string::npos;
  if (plain) value[comma] = '.';
  return value;
}

// --- Valentina, Seamly2D: every value is a formula of plain numbers in the file's unit.
class ValentinaNames : public FormulaNames {
 public:
  std::map<std::string, std::string> values;
  Result<Quantity> named(const std::string& name) override {
    if (const auto at = known_.find(name); at != known_.end()) return at->second;
    const auto value = values.find(name);
    if (value == values.end()) return notFound(say("There is no measurement called \"{0}\".", shown(name)));
    const bool circle = std::find(asking_.begin(), asking_.end(), name) != asking_.end();
    if (circle || asking_.size() > 100) return refused(say("This goes round in a circle: {0}.", shown(name)));
    const auto formula = Formula::parse(value->second);
    if (!formula) return formula.error();
    asking_.push_back(name);
    auto found = evaluate(*formula, *this);
    asking_.pop_back();
    if (found) known_[name] = *found;
    return found;
  }
  Result<double> edgeLength(const EdgeRef&, bool) override { return notMeasures(); }

 private:
  std::map<std::string, Quantity> known_;
  std::vector<std::string> asking_;
};

// --- "section.name" and value, of YAML's and JSON's plain maps.
using Entries = std::map<std::string, std::string>;

// The part of YAML that such files use: "name: value", sections by indentation, comments. Lists and all else are passed
// over.
Entries yamlEntries(std::string_view bytes) {
  struct Section {
    std::size_t indent;
    std::string path;
  };
  std::vector<Section> open;
  Entries all;
  for (std::string_view line : linesOf(bytes)) {
    if (const std::size_t comment = line.find(" #"); comment != std::string_view::npos) line = line.substr(0, comment);
    const std::size_t indent = line.find_first_not_of(' ');
    const std::string_view text = trimmed(line);
    const std::size_t colon = text.find(':');
    if (text.empty() || text[0] == '#' || text[0] == '-' || colon == std::string_view::npos) continue;
    while (!open.empty() && open.back().indent >= indent) open.pop_back();
    std::string_view name = trimmed(text.substr(0, colon)), value = trimmed(text.substr(colon + 1));
    const auto unquoted = [](std::string_view t) {
      const bool quoted = t.size() >= 2 && (t[0] == '"' || t[0] == '\'') && t.back() == t[0];
      return quoted ? t.substr(1, t.size() - 2) : t;
    };
    std::string path = open.empty() ? std::string() : open.back().path + ".";
    path += unquoted(name).substr(0, kLongestName);
    if (value.empty() && open.size() < 16)
      open.push_back({indent, path});
    else if (all.size() <= kMostEntries)
      all[path] = unquoted(value);
  }
  return all;
}

void jsonEntries(const Json& value, const std::string& path, Entries& all) {
  if (value.is_object()) {
    for (const auto& [name, own] : value.items())
      jsonEntries(own, (path.empty() ? "" : path + ".") + name.substr(0, kLongestName), all);
  } else if (all.size() > kMostEntries) {
    return;
  } else if (isFinite(value)) {
    all[path] = shortest(value.get<double>());
  } else if (value.is_string()) {
    all[path] = value.get<std::string>();
  }
}

// GarmentCode has a section "body" in centimetres; FreeSewing millimetres, in a section or bare.
Result<MeasuresRead> ofEntries(const Entries& entries) {
  if (entries.size() > kMostEntries) return tooMany();
  const bool garmentCode = std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
    return entry.first.starts_with("body.") && parseNumber(entry.second);
  });
  MeasuresRead read;
  for (const auto& [path, value] : entries) {
    const std::size_t dot = path.rfind('.');
    const std::string name = dot == std::string::npos ? path : path.substr(dot + 1);
    if (garmentCode && !path.starts_with("body.")) continue;
    if (const auto number = parseNumber(value))
      take(read, garmentCode ? &MeasureNames::garmentCode : &MeasureNames::freeSewing, name, *number,
           garmentCode ? 0.01 : 0.001);
  }
  return unlessEmpty(std::move(read));
}

}  // namespace

Result<MeasuresRead> readValentina(std::string_view bytes) {
  if (bytes.size() > kMostBytes) return tooLarge();
  const auto elements = parseXml(bytes);
  if (!elements) return elements.error();
  const std::string& root = elements->front().name;
  if (root != "vit" && root != "smis" && root != "vst" && root != "smms") return notMeasures();
  MeasuresRead read;
  ValentinaNames names;
  double unit = 0.01;
  for (const XmlElement& element : *elements) {
    if (element.name == "unit") {
      const std::string_view said = trimmed(element.text);
      if (said != "mm" && said != "cm" && said != "inch")
        return badInput(say("“{0}” is no unit; a file of measures has mm, cm or inch.", shown(said)));
      unit = said == "mm" ? 0.001 : said == "cm" ? 0.01 : 0.0254;
    }
    if (element.name == "gender" && trimmed(element.text) == "male") read.measures.sex = Sex::Male;
    if (element.name != "m") continue;
    const std::string* name = element.find("name");
    const std::string* value = element.find("value");
    if (!value) value = element.find("base");  // of several sizes the base size
    if (name && value) names.values[*name] = withDecimalPoint(*value);
  }
  if (names.values.size() > kMostEntries) return tooMany();
  for (const auto& [name, formula] : names.values) {
    const auto value = names.named(name);
    const bool number = value && value->dimension == kPlainNumber;
    if (!number && !trimmed(formula).empty() && !measureKeyIn(&MeasureNames::valentina, name).empty()) {
      const Message why = value ? say("it is no plain number") : value.error().what;
      read.unread.push_back({shown(name), say("“{0}” is left out, since its value “{1}” cannot be worked out: {2}",
                                              shown(name), shown(formula), why)});
      continue;
    }
    take(read, &MeasureNames::valentina, name, number ? value->value : 0, unit);
  }
  return unlessEmpty(std::move(read));
}

Result<MeasuresRead> readMeasuresYaml(std::string_view bytes) {
  if (bytes.size() > kMostBytes) return tooLarge();
  if (bytes.find('\0') != std::string_view::npos) return notMeasures();
  return ofEntries(yamlEntries(bytes));
}

Result<MeasuresRead> readMeasuresJson(std::string_view bytes) {
  if (bytes.size() > kMostBytes) return tooLarge();
  const auto json = parseStrictJson(bytes);
  if (!json) return json.error();
  Entries entries;
  jsonEntries(*json, {}, entries);
  return ofEntries(entries);
}

// "bust_girth = 88cm", one a line; # begins a comment.
Result<MeasuresRead> readMeasuresText(std::string_view bytes) {
  if (bytes.size() > kMostBytes) return tooLarge();
  MeasuresRead read;
  int number = 0;
  for (const std::string_view line : linesOf(bytes)) {
    ++number;
    const std::string_view text = trimmed(line.substr(0, line.find('#')));
    if (text.empty()) continue;
    const auto at = [&](const Message& what) { return badInput(say("Line {0}: {1}", number, what)); };
    const std::size_t is = text.find('=');
    if (is == std::string_view::npos)
      return at(say("“{0}” is not a measurement; write it like bust_girth=88cm.", shown(text)));
    const std::string_view name = trimmed(text.substr(0, is));
    const std::string value = withUnitClose(trimmed(text.substr(is + 1)));
    if (name == "sex") {
      const auto sex = sexNamed(value);
      if (!sex) return at(say("“{0}” is not one of: {1}.", shown(value), "female, male, child"));
      read.measures.sex = *sex;
      continue;
    }
    const auto key = measurementKey(name);
    if (!key) return at(key.error().what);
    if (const Done meant = isAngle(*key) ? Done() : unitMeant(value); !meant) return at(meant.error().what);
    const auto measure = isAngle(*key) ? parseAngle(value) : parseLength(value);
    if (!measure) return at(measure.error().what);
    if (!read.measures.value.emplace(*key, *measure).second)
      return at(say("The measurement {0} is given twice.", *key));
  }
  return unlessEmpty(std::move(read));
}

}  // namespace karinui
