#include "karinui/base/message.h"

#include <cstdlib>
#include <map>

#include "karinui/base/number.h"

namespace karinui {

extern const char kJapaneseCatalogue[];
extern const std::size_t kJapaneseCatalogueSize;

namespace {

// Lines of "pattern<TAB>translation".
std::map<std::string_view, std::string_view> readCatalogue(std::string_view tsv) {
  std::map<std::string_view, std::string_view> catalogue;
  while (!tsv.empty()) {
    const std::size_t end = std::min(tsv.find('\n'), tsv.size());
    const std::string_view line = tsv.substr(0, end);
    tsv.remove_prefix(std::min(end + 1, tsv.size()));
    if (const std::size_t tab = line.find('\t'); tab != std::string_view::npos) {
      catalogue.emplace(line.substr(0, tab), line.substr(tab + 1));
    }
  }
  return catalogue;
}

std::string_view translated(std::string_view pattern) {
  static const auto catalogue = readCatalogue({kJapaneseCatalogue, kJapaneseCatalogueSize});
  const auto found = catalogue.find(pattern);
  return found == catalogue.end() ? pattern : found->second;
}

}  // namespace

std::string written(double value) { return shortest(value); }
std::string written(long long value) { return std::to_string(value); }

std::string text(const Message& message, Language language) {
  const std::string_view pattern =
      language == Language::Japanese ? translated(message.pattern) : std::string_view(message.pattern);
  std::string said;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::size_t which = i + 2 < pattern.size() && pattern[i] == '{' && pattern[i + 2] == '}'
                                  ? static_cast<std::size_t>(pattern[i + 1] - '0')
                                  : message.values.size();
    if (which < message.values.size()) {
      said += text(message.values[which], language);
      i += 2;
    } else {
      said += pattern[i];
    }
  }
  return said;
}

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
