#include "karinui/base/number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

namespace karinui {

namespace {

struct Unit {
  std::string_view name;
  double factor;
};

// `times` 1/1000 would round twice: dividing by the reciprocal keeps 12mm the double nearest to 0.012.
Result<double> parseWithUnit(std::string_view text, std::string_view kind, std::span<const Unit> units,
                             std::string_view examples) {
  std::size_t digits = text.size();
  while (digits > 0 && (std::isalpha(static_cast<unsigned char>(text[digits - 1])) != 0)) --digits;
  const std::string_view suffix = text.substr(digits);
  if (const auto number = parseNumber(text.substr(0, digits))) {
    for (const Unit& unit : units) {
      if (unit.name == suffix) return unit.factor < 1 ? *number / std::round(1 / unit.factor) : *number * unit.factor;
    }
  }
  return badInput(say("“{0}” is not {1}; write it like {2}.", text, kind, examples));
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<double> parseLength(std::string_view text) {
  static constexpr std::array<Unit, 4> kUnits{{{"", 1}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}}};
  if (text.ends_with("in")) {  // 0.0254 is not one over a whole number
    if (const auto inches = parseNumber(text.substr(0, text.size() - 2))) return *inches * 0.0254;
  }
  return parseWithUnit(text, "a length", kUnits, "88cm, 12mm, 0.3m or 5in");
}

Result<double> parseAngle(std::string_view text) {
  if (text.ends_with("deg")) {
    if (const auto degrees = parseNumber(text.substr(0, text.size() - 3))) return *degrees * std::numbers::pi / 180;
  }
  static constexpr std::array<Unit, 2> kUnits{{{"", 1}, {"rad", 1}}};
  return parseWithUnit(text, "an angle", kUnits, "30deg or 0.5rad");
}

std::string shortest(double value) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), end);
}

std::string fixed(double value, int decimals) {
  std::array<char, 400> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  std::string digits(buffer.data(), end);
  if (digits.starts_with('-') && digits.find_first_of("123456789") == std::string::npos) digits.erase(0, 1);
  return digits;
}

}  // namespace karinui
