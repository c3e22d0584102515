#include "design/text/units_meant.h"

#include <algorithm>
#include <cmath>

#include "design/text/value_text.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

constexpr double kLeastDoubtful = 2;  // metres

// The parts of a list between any of the separators.
std::vector<std::string_view> partsOf(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

Done unitMeant(std::string_view length) {
  const auto metres = parseNumber(length);
  if (!metres || std::fabs(*metres) < kLeastDoubtful || lengthText(*metres) == length) return {};
  return badInput(
      say("“{0}” has no unit and would be {0} metres; write {0}cm or {0}mm, or {0}m if it is meant.", length));
}

Done unitsMeant(std::string_view kind, std::string_view text) {
  if (kind.starts_with("list of ")) kind.remove_prefix(8);
  if (kind != "length" && kind != "u,v" && kind != "x,y,z" && kind != "measurement=length") return {};
  for (const std::string_view item : partsOf(text, ";,")) {
    const auto words = partsOf(item, " \t\r\n");
    const auto lengthIn = [](std::string_view word) { return word.substr(word.find('=') + 1); };
    const std::string_view whole = trimmed(lengthIn(item));
    if (!parseNumber(whole) && parseLength(whole)) continue;  // 34 1/2in, whose first word is no length of its own
    const bool plain = std::all_of(words.begin(), words.end(), [&](std::string_view word) {
      return static_cast<bool>(parseLength(lengthIn(word)));
    });
    if (!plain) continue;  // a formula
    for (const std::string_view word : words) {
      if (word.find('=') != std::string_view::npos && isAngle(word.substr(0, word.find('=')))) continue;
      if (Done done = unitMeant(lengthIn(word)); !done) return done;
    }
  }
  return {};
}

}  // namespace karinui
