#include <cctype>
#include <charconv>

#include "design/text/value_text.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

// Decimal digits and a power of ten as plain text without exponent: ("125", -1) -> "12.5".
std::string plain(bool negative, const std::string& digits, int exponent) {
  std::string all(negative ? 1 : 0, '-');
  if (exponent >= 0) return all.append(digits).append(static_cast<std::size_t>(exponent), '0');
  const auto places = static_cast<std::size_t>(-exponent);
  if (digits.size() <= places) {
    all.append("0.").append(places - digits.size(), '0').append(digits);
  } else {
    all.append(digits, 0, digits.size() - places).append(".").append(digits, digits.size() - places);
  }
  return all;
}

// The same with the power of ten written out, for absurd sizes.
std::string withPower(bool negative, const std::string& digits, int exponent) {
  std::string all(negative ? 1 : 0, '-');
  return all.append(digits).append("e").append(std::to_string(exponent));
}

struct Decimal {
  bool negative = false;
  std::string digits;  // no point, at least one
  int exponent = 0;
};

// Takes "-1.25e-3" apart; assumes a number as parseNumber or to_chars writes it.
Decimal takenApart(std::string_view text) {
  Decimal d;
  if (text.starts_with('-')) d.negative = true, text.remove_prefix(1);
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), d.exponent);
    text = text.substr(0, e);
  }
  const std::size_t point = text.find('.');
  d.digits = text.substr(0, point);
  if (point != std::string_view::npos) {
    d.digits += text.substr(point + 1);
    d.exponent -= static_cast<int>(text.size() - point - 1);
  }
  while (d.digits.size() > 1 && d.digits.back() == '0') d.digits.pop_back(), ++d.exponent;
  if (const std::size_t first = d.digits.find_first_not_of('0'); first != std::string::npos) {
    d.digits.erase(0, first);
  } else {
    d.digits.assign(1, '0'), d.exponent = 0;
  }
  return d;
}

}  // namespace

std::string millimetreText(double metres) {
  const Decimal d = takenApart(shortest(metres));
  const int exponent = d.digits == "0" ? 0 : d.exponent + 3;
  if (exponent > 20 || exponent < -30) {  // absurd sizes: keep the text short
    return withPower(d.negative, d.digits, exponent);
  }
  return plain(d.negative, d.digits, exponent);
}

std::optional<double> parseMillimetres(std::string_view text) {
  if (!parseNumber(text)) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  const Decimal d = takenApart(text);
  if (d.digits.size() > 400 || d.exponent > 400 || d.exponent < -800) return std::nullopt;
  return parseNumber(withPower(d.negative, d.digits, d.exponent - 3));
}

std::string lengthText(double metres) {
  if (metres == 0) return shortest(metres);
  const std::string text = millimetreText(metres) + "mm";
  if (const auto back = parseLength(text); back && *back == metres) return text;
  return shortest(metres);
}

std::string withShortLengths(std::string_view operations) {
  constexpr std::size_t kNoisy = 15;  // digits, the point among them: with fewer no shorter number is the same
  const auto inNumber = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  const auto inWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string all;
  all.reserve(operations.size());
  for (std::size_t at = 0; at < operations.size();) {
    std::size_t end = at;
    while (end < operations.size() && inNumber(operations[end])) ++end;
    std::string_view word = operations.substr(at, end - at);
    const bool length = word.size() >= kNoisy && operations.substr(end, 2) == "mm" &&
                        (end + 2 == operations.size() || !inWord(operations[end + 2])) &&
                        (all.empty() || !inWord(all.back()));
    std::string shorter;
    if (const auto number = length ? parseNumber(word) : std::nullopt) {
      const auto same = [&](std::string_view text) { return *parseLength(std::string(text) + "mm"); };
      for (int decimals = 0; decimals < 14 && shorter.empty(); ++decimals)
        if (const std::string one = fixed(*number, decimals); one.size() < word.size() && same(one) == same(word))
          shorter = one;
    }
    all += shorter.empty() ? std::string(word) : shorter;
    if (end == at) all += operations[end++];
    at = end;
  }
  return all;
}

}  // namespace karinui
