#include "design/text/formula_fields.h"

#include <cmath>

#include "design/text/value_text.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

// Splits outside of brackets.
std::vector<std::string_view> splitOutside(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && (text[i] == '(' || text[i] == '[')) ++depth;
    if (i < text.size() && (text[i] == ')' || text[i] == ']')) --depth;
    if (i < text.size() && (text[i] != separator || depth > 0)) continue;
    parts.push_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  return parts;
}

class FieldReading {
 public:
  explicit FieldReading(const FormulaValue& value) : value_(value) {}

  Done read(std::string_view kind, std::string_view text) {
    if (kind.starts_with("list of ")) return list(kind.substr(8), text, ';', "; ");
    if (kind == "u,v" || kind == "x,y,z") return places(text, kind == "u,v" ? 2 : 3);
    if (kind == "length") return number(text, kLength);
    if (kind == "angle") return number(text, kAngle);
    if (kind == "number") return number(text, kPlainNumber);
    if (kind == "axis angle") return turn(text);
    if (kind == "outline" || kind == "outlines" || kind == "lines") return path(text);
    return badInput(say("No formula can stand here."));
  }
  FieldWorkedOut taken() { return {std::move(formulas_), std::move(plain_), any_}; }

 private:
  void both(std::string_view text) { formulas_ += text, plain_ += text; }

  Result<Quantity> formula(std::string_view text, Dimension wanted, std::string& written) {
    auto read = Formula::parse(text);
    if (!read) return read.error();
    any_ = true;
    const auto value = value_(*read);
    if (!value) return value;
    written = read->text();
    if (value->dimension != wanted)
      return refused(
          say("“{0}” is {1}; here goes {2}.", written, dimensionSaid(value->dimension), dimensionSaid(wanted)));
    return value;
  }

  // A plain number is read as everywhere: metres or radians without a unit.
  Done number(std::string_view text, Dimension wanted) {
    const auto isPlain = [&](std::string_view number) {
      const auto plain = wanted == kLength  ? parseLength(number)
                         : wanted == kAngle ? parseAngle(number)
                                            : parseNumber(number).value_or(NAN);
      if (!plain || !std::isfinite(*plain)) return false;
      both(wanted == kLength ? lengthText(*plain) : shortest(*plain));
      return true;
    };
    text = trimmed(text);
    if (isPlain(text)) return {};
    const bool before = any_;
    std::string written;
    const auto value = formula(text, wanted, written);
    if (!value) return value.error();
    if (isPlain(written)) {  // but for its signs, which were those of another script
      any_ = before;
      return {};
    }
    formulas_ += written;
    plain_ += shortest(value->value);
    return {};
  }

  Done list(std::string_view kind, std::string_view text, char separator, std::string_view between) {
    bool first = true;
    for (const std::string_view item : splitOutside(text, separator)) {
      if (trimmed(item).empty()) continue;
      if (!first) both(between);
      first = false;
      if (Done done = read(kind, item); !done) return done;
    }
    return {};
  }

  Done places(std::string_view text, std::size_t count) {
    const auto parts = splitOutside(text, ',');
    if (parts.size() != count)
      return badInput(count == 2 ? say("“{0}” is not a place on paper; write it like 12cm,3cm.", text)
                                 : say("“{0}” is not a step in space; write it like 0,5cm,10cm.", text));
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) both(",");
      if (Done done = number(parts[i], kLength); !done) return done;
    }
    return {};
  }

  Done turn(std::string_view text) {
    text = trimmed(text);
    const std::size_t end = text.find(' ');
    if (end == std::string_view::npos)
      return badInput(say("“{0}” is not a turn; write an axis and an angle, like “y 90deg”.", text));
    both(text.substr(0, end));
    both(" ");
    return number(text.substr(end), kAngle);
  }

  // Millimetres, and formulas of lengths in brackets.
  Done path(std::string_view text) {
    while (!text.empty()) {
      const std::size_t begin = text.find('(');
      both(text.substr(0, begin));
      if (begin == std::string_view::npos) return {};
      std::size_t end = begin, depth = 0;
      for (; end < text.size(); ++end) {
        if (text[end] == '(') ++depth;
        if (text[end] == ')' && --depth == 0) break;
      }
      if (end == text.size())
        return badInput(say("The bracket before “{0}” is never closed.", text.substr(begin + 1, 40)));
      std::string written;
      const auto value = formula(text.substr(begin + 1, end - begin - 1), kLength, written);
      if (!value) return value.error();
      formulas_ += "(" + written + ")";
      plain_ += millimetreText(value->value);
      text.remove_prefix(end + 1);
    }
    return {};
  }

  const FormulaValue& value_;
  std::string formulas_, plain_;
  bool any_ = false;
};

}  // namespace

Result<FieldWorkedOut> workedOutField(std::string_view kind, std::string_view text, const FormulaValue& value) {
  FieldReading reading(value);
  if (Done done = reading.read(kind, text); !done) return done.error();
  return reading.taken();
}

bool seemsFormula(std::string_view kind, std::string_view text) {
  if (kind.starts_with("list of ")) kind.remove_prefix(8);
  static constexpr std::string_view kNumbers = " length angle number u,v x,y,z axis outline outlines lines ";
  if (kNumbers.find(" " + std::string(kind.substr(0, kind.find(' '))) + " ") == std::string_view::npos) return false;
  if (kind.find("outline") != std::string_view::npos || kind == "lines")
    return text.find('(') != std::string_view::npos;
  text = trimmed(text);
  const bool word = !text.empty() && !(text[0] >= '0' && text[0] <= '9') && text[0] != '-' && text[0] != '.';
  return word || text.find_first_of("+*/^(") != std::string_view::npos;
}

}  // namespace karinui
