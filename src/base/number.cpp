#include "karinui/base/number.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

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

// Feet, inches and fractions of them, as tape measures of the United States have them: 27 1/2in, 27-1/2", 1/2 in, 27½",
// 5'7", 5 ft 7 1/2 in. Nothing: the text is something else, or decimals of an inch, which are read as any other unit.
class FeetAndInches {
 public:
  explicit FeetAndInches(std::string_view text) : text_(halfWidth(text)) {
    static constexpr std::pair<std::string_view, std::string_view> kSigns[]{
        {"½", " 1/2"}, {"¼", " 1/4"}, {"¾", " 3/4"}, {"⅛", " 1/8"}, {"⅜", " 3/8"}, {"⅝", " 5/8"}, {"⅞", " 7/8"},
        {"⁄", "/"},    {"　", " "},   {"″", "\""},   {"”", "\""},   {"′", "'"},    {"’", "'"}};
    for (const auto& [typed, plain] : kSigns)
      for (std::size_t at = text_.find(typed); at != std::string::npos; at = text_.find(typed))
        text_.replace(at, typed.size(), plain);
    rest_ = trimmed(text_);
  }

  std::optional<double> metres() {
    constexpr double kInch = 0.0254, kFoot = 12;  // in inches
    if (rest_.find_first_of("/'\"") == std::string_view::npos && rest_.find("ft") == std::string_view::npos)
      return std::nullopt;
    const double sign = take("-") ? -1 : 1;
    double inches = 0;
    const std::string_view all = rest_;
    const auto feet = digits();
    const bool inFeet = feet && (skip(), take("'") || take("ft"));
    if (inFeet)
      inches = *feet * kFoot, skip(), take("-"), skip();
    else
      rest_ = all;
    if (!inFeet || !rest_.empty()) {
      const auto more = inchesAndFraction();
      if (!more) return std::nullopt;
      inches += *more, skip();
      if (!take("inches") && !take("inch") && !take("in") && !take("\"") && !inFeet) return std::nullopt;
    }
    if (!rest_.empty()) return std::nullopt;
    return sign * inches * kInch;
  }

 private:
  void skip() {
    while (!rest_.empty() && isSpace(rest_.front())) rest_.remove_prefix(1);
  }
  bool take(std::string_view sign) {
    const bool there = rest_.starts_with(sign);
    if (there) rest_.remove_prefix(sign.size());
    return there;
  }
  std::optional<double> digits(std::string_view of = "0123456789") {
    const std::size_t end = std::min(rest_.find_first_not_of(of), rest_.size());
    const auto number = end > 0 ? parseNumber(rest_.substr(0, end)) : std::nullopt;
    if (number) rest_.remove_prefix(end);
    return number;
  }
  // 27, 27.5, 1/2, 27 1/2 or 27-1/2.
  std::optional<double> inchesAndFraction() {
    const std::string_view all = rest_;
    const auto whole = digits();
    if (!whole || rest_.starts_with(".")) return rest_ = all, digits("0123456789.");
    if (take("/")) return rest_ = all, fraction();
    const std::string_view behind = rest_;
    skip(), take("-"), skip();
    if (behind.size() > rest_.size())
      if (const auto part = fraction()) return *whole + *part;
    return rest_ = behind, whole;
  }
  std::optional<double> fraction() {
    const auto part = digits();
    if (!part || !take("/")) return std::nullopt;
    const auto of = digits();
    return of && *of > 0 && *part < *of ? std::optional(*part / *of) : std::nullopt;
  }

  std::string text_;
  std::string_view rest_;
};

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
  if (const auto metres = FeetAndInches(text).metres()) return *metres;
  return badInput(say("“{0}” is not a length; write it like 88cm, 12mm, 0.3m, 5in or 27 1/2in.", text));
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
