#pragma once
// Numbers as text, always in the "C" way (point as decimal sign), whatever the person's locale.
// What cannot be read is refused with Error::Kind::BadInput and a sentence that quotes it. Any thread.
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

constexpr double kFullTurn = 2 * std::numbers::pi;  // radians
constexpr double kDegree = std::numbers::pi / 180;  // in radians

// The text without white space at its ends.
std::string_view trimmed(std::string_view text);
bool isSpace(char c);  // space, tab or the end of a line

// Digits, letters and signs of full width, as Japanese input gives them, in their usual form: "９５．５ｃｍ" is
// "95.5cm". Numbers, lengths and angles are read so.
std::string halfWidth(std::string_view text);

// The whole text as one finite number; nothing if any of it is something else.
std::optional<double> parseNumber(std::string_view text);

// A length: "88cm", "12mm", "0.3m", "5in", or a bare number in metres.
Result<double> parseLength(std::string_view text);

// An angle: "30deg", "0.5rad", or a bare number in radians.
Result<double> parseAngle(std::string_view text);

// The shortest text that reads back as the same double.
std::string shortest(double value);

// Fixed decimals, no negative zero: fixed(1.2345, 2) == "1.23".
std::string fixed(double value, int decimals);

// A length as a person reads it: "12.3 cm", or "4.84 in" (a decimal more: an inch is longer).
std::string lengthSaid(double metres, bool inches, int decimals = 1);

}  // namespace karinui
