#include "karinui/base/number.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

namespace karinui {

namespace {

constexpr char kWide = '\xef';  // the first byte of U+FF01 to U+FF5E in UTF-8

struct Unit {
  std::string_view name;
  double perUnit;  // how many of it make one metre or radian: dividing keeps 12mm the double nearest to 0.012
};

bool hasWide(std::string_view text) { return text.find(kWide) != std::string_view::npos; }

std::optional<double> parseWithUnit(std::string_view text, std::span<const Unit> units) {
  if (hasWide(text)) {
    const std::string plain = halfWidth(text);
    return hasWide(plain) ? std::nullopt : parseWithUnit(plain, units);
  }
  std::size_t digits = text.size();
  while (digits > 0 && std::isalpha(static_cast<unsigned char>(text[digits - 1])) != 0) --digits;
  const auto number = parseNumber(text.substr(0, digits));
  if (!number) return std::nullopt;
  for (const Unit& unit : units) {
    if (unit.name == text.substr(digits)) return *number / unit.perUnit;
  }
  return std::nullopt;
}

}  // namespace

constexpr std::string_view kSpace = " \t\r\n";

bool isSpace(char c) { return kSpace.find(c) != std::string_view::npos; }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string halfWidth(std::string_view text) {
  constexpr unsigned kFirst = 0xFF01, kLast = 0xFF5E, kApart = 0xFF01 - '!';
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == kWide && k + 2 < text.size()) {
      const auto low = [&](std::size_t i) { return static_cast<unsigned char>(text[i]) & 0x3FU; };
      const unsigned code = 0xF000U | low(k + 1) << 6 | low(k + 2);
      if (code >= kFirst && code <= kLast) {
        out += static_cast<char>(code - kApart);
        k += 2;
        continue;
      }
    }
    out += text[k];
  }
  return out;
}

std::optional<double> parseNumber(std::string_view text) {
  if (hasWide(text)) {
    const std::string plain = halfWidth(text);
    return hasWide(plain) ? std::nullopt : parseNumber(plain);
  }
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<double> parseLength(std::string_view text) {
  static constexpr std::array<Unit, 5> kUnits{{{"", 1}, {"m", 1}, {"cm", 100}, {"mm", 1000}, {"in", 1 / 0.0254}}};
  if (const auto metres = parseWithUnit(text, kUnits)) return *metres;
  return badInput(say("“{0}” is not a length; write it like 88cm, 12mm, 0.3m or 5in.", text));
}

Result<double> parseAngle(std::string_view text) {
  static constexpr std::array<Unit, 3> kUnits{{{"", 1}, {"rad", 1}, {"deg", 180 / std::numbers::pi}}};
  if (const auto radians = parseWithUnit(text, kUnits)) return *radians;
  return badInput(say("“{0}” is not an angle; write it like 30deg or 0.5rad.", text));
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

std::string lengthSaid(double metres, bool inches, int decimals) {
  return inches ? fixed(metres / 0.0254, decimals + 1) + " in" : fixed(metres * 100, decimals) + " cm";
}

}  // namespace karinui
