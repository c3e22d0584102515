#include "karinui/base/message.h"

#include <cstdlib>
#include <map>
#include <optional>

#include "karinui/base/number.h"
#include "karinui/base/said_lengths.h"

namespace karinui {

extern const char kJapaneseCatalogue[];
extern const std::size_t kJapaneseCatalogueSize;

namespace {

// "{0|edge|edges}": one of two words, by whether value 0 is one.
struct Counted {
  std::size_t which = 0, size = 0;  // of the values; letters of the pattern
  std::string_view one, many;
};
std::optional<Counted> countedAt(std::string_view pattern) {
  if (pattern.size() < 5 || pattern[0] != '{' || pattern[1] < '0' || pattern[1] > '9' || pattern[2] != '|')
    return std::nullopt;
  const std::size_t middle = pattern.find('|', 3), end = pattern.find('}');
  if (end == std::string_view::npos || middle > end) return std::nullopt;
  return Counted{static_cast<std::size_t>(pattern[1] - '0'), end + 1, pattern.substr(3, middle - 3),
                 pattern.substr(middle + 1, end - middle - 1)};
}

// A pattern as it read before it knew of a singular: sentences are kept so in documents.
std::string manyOf(std::string_view pattern) {
  std::string plain;
  for (std::size_t i = 0; i < pattern.size();) {
    const auto counted = countedAt(pattern.substr(i));
    plain += counted ? std::string(counted->many) : std::string(1, pattern[i]);
    i += counted ? counted->size : 1;
  }
  return plain;
}

// Lines of "pattern<TAB>translation".
std::map<std::string, std::string_view> readCatalogue(std::string_view tsv) {
  std::map<std::string, std::string_view> catalogue;
  while (!tsv.empty()) {
    const std::size_t end = std::min(tsv.find('\n'), tsv.size());
    const std::string_view line = tsv.substr(0, end);
    tsv.remove_prefix(std::min(end + 1, tsv.size()));
    if (const std::size_t tab = line.find('\t'); tab != std::string_view::npos) {
      catalogue.emplace(manyOf(line.substr(0, tab)), line.substr(tab + 1));
    }
  }
  return catalogue;
}

std::string_view translated(std::string_view pattern) {
  static const auto catalogue = readCatalogue({kJapaneseCatalogue, kJapaneseCatalogueSize});
  const auto found = catalogue.find(manyOf(pattern));
  return found == catalogue.end() ? pattern : found->second;
}

}  // namespace

std::string written(double value) { return shortest(value); }
std::string written(long long value) { return std::to_string(value); }

namespace {

struct LengthUnit {
  std::string_view written;
  double metres;
};
constexpr LengthUnit kUnits[]{{" mm", 0.001}, {" cm", 0.01}};

// The unit that stands here; areas ("cm2") are none.
const LengthUnit* unitAt(std::string_view pattern) {
  for (const LengthUnit& unit : kUnits)
    if (pattern.starts_with(unit.written) && !pattern.substr(unit.written.size()).starts_with('2')) return &unit;
  return nullptr;
}

// The unit that stands behind the other end, where what stands here begins a range: "3 to 50 mm".
const LengthUnit* unitOfRange(std::string_view pattern) {
  for (const std::string_view between : {" to ", " and ", "～", "〜", " から "}) {
    if (!pattern.starts_with(between)) continue;
    pattern.remove_prefix(between.size());
    if (pattern.size() > 2 && pattern[0] == '{' && pattern[2] == '}') return unitAt(pattern.substr(3));
    const std::size_t end = std::min(pattern.find_first_not_of("0123456789."), pattern.size());
    return end > 0 ? unitAt(pattern.substr(end)) : nullptr;
  }
  return nullptr;
}

// Lengths in other words; several, as a place has them, between what stands between them. Nothing: no number.
std::optional<std::string> reworded(std::string_view millimetres, const LengthUnit& unit, LengthWords lengths) {
  std::string said;
  bool any = false;
  for (std::size_t i = 0; i < millimetres.size();) {
    const std::size_t end = std::min(millimetres.find_first_not_of("-0123456789.", i), millimetres.size());
    if (const auto number = parseNumber(millimetres.substr(i, end - i))) {
      said += lengths(*number * unit.metres);
      any = true;
    } else {
      said += millimetres.substr(i, std::max(end, i + 1) - i);
    }
    i = std::max(end, i + 1);
  }
  return any ? std::optional(said) : std::nullopt;
}

// Whether a Japanese letter or sign stands there: U+3000 to U+D7FF, or full-width.
bool isWide(std::string_view letters) {
  if (letters.empty()) return false;
  const auto lead = static_cast<unsigned char>(letters.front());
  return (lead >= 0xe3 && lead <= 0xed) || lead == 0xef;
}
bool endsWide(std::string_view letters) { return letters.size() >= 3 && isWide(letters.substr(letters.size() - 3)); }

// Puts a value into a Japanese sentence, whose blanks are for values of letters and digits. `before`: where the value
// before ends in what was said. Gives how much of what follows is left out.
std::size_t putJapanese(std::string& said, std::size_t before, std::string_view part, std::string_view rest) {
  constexpr std::string_view kEdge = "辺", kQuote = "「";
  if (said.ends_with(' ') && said.size() - 1 > before && isWide(part) &&
      endsWide(std::string_view(said).substr(0, said.size() - 1)))
    said.pop_back();
  // An edge that has only a number says itself that it is an edge.
  const std::string twice = std::string(kEdge) + std::string(kQuote);
  if (said.ends_with(twice) && part.starts_with(kEdge)) said.erase(said.size() - twice.size()), said += kQuote;
  said += part;
  return endsWide(part) && rest.starts_with(' ') && isWide(rest.substr(1)) ? 1 : 0;
}

}  // namespace

std::string text(const Message& message, Language language, LengthWords lengths, const NameWords& names,
                 PatternWords patterns) {
  const std::string_view kept =
      language == Language::Japanese ? translated(message.pattern) : std::string_view(message.pattern);
  const std::string changed = patterns ? patterns(message.pattern, kept, language) : std::string();
  const std::string_view pattern = patterns ? std::string_view(changed) : kept;
  std::string said;
  std::size_t valueEnd = 0;  // of the last one, in what is said
  for (std::size_t i = 0; i < pattern.size();) {
    if (const auto counted = countedAt(pattern.substr(i)); counted && counted->which < message.values.size()) {
      said += text(message.values[counted->which]) == "1" ? counted->one : counted->many;
      i += counted->size;
      continue;
    }
    // A value, or a number that stands in the pattern itself.
    const std::size_t which = i + 2 < pattern.size() && pattern[i] == '{' && pattern[i + 2] == '}'
                                  ? static_cast<std::size_t>(pattern[i + 1] - '0')
                                  : message.values.size();
    const bool value = which < message.values.size();
    const bool fresh = said.empty() || std::string_view("0123456789.").find(said.back()) == std::string_view::npos;
    std::size_t end = value ? i + 3 : i + 1;
    if (!value && fresh) end = std::max(end, std::min(pattern.find_first_not_of("0123456789.", i), pattern.size()));
    const Message* sentence = value ? std::get_if<Message>(&message.values[which]) : nullptr;
    std::string part = sentence ? text(*sentence, language, lengths, names, patterns)
                       : value  ? std::get<std::string>(message.values[which])
                                : std::string(pattern.substr(i, end - i));
    if (const auto name = names && value && !sentence ? names(part) : std::nullopt) part = text(*name, language);
    if (lengths) {
      const std::string_view rest = pattern.substr(end);
      const LengthUnit* own = unitAt(rest);
      if (const LengthUnit* unit = own ? own : unitOfRange(rest))
        if (auto words = reworded(part, *unit, lengths)) {
          part = *std::move(words);
          if (own) end += own->written.size();
        }
    }
    if (value && language == Language::Japanese)
      end += putJapanese(said, valueEnd, part, pattern.substr(end));
    else
      said += part;
    if (value) valueEnd = said.size();
    i = end;
  }
  return said;
}

std::string text(const Message& message, Language language) { return text(message, language, nullptr); }

std::string text(const Message::Value& value, Language language) {
  const Message* sentence = std::get_if<Message>(&value);
  return sentence ? text(*sentence, language) : std::get<std::string>(value);
}

Language spokenHere() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    if (const char* value = std::getenv(name); value && *value) {
      return std::string_view(value).starts_with("ja") ? Language::Japanese : Language::English;
    }
  }
  return Language::English;
}

}  // namespace karinui
