#include "readable_lengths.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui::app {

namespace {

constexpr double kNoise = 1e-7;  // mm

// "112.50" as "112.5".
std::string hundredths(double number) {
  std::string written = fixed(number, 2);
  while (written.ends_with('0')) written.pop_back();
  if (written.ends_with('.')) written.pop_back();
  return written;
}

}  // namespace

std::string withReadableLengths(std::string_view operations) {
  const bool screen = isatty(STDOUT_FILENO) != 0;
  std::string all;
  for (std::size_t at = 0; at < operations.size();) {
    std::size_t end = at;
    while (end < operations.size() &&
           (std::isdigit(static_cast<unsigned char>(operations[end])) || operations[end] == '.'))
      ++end;
    const std::string_view word = operations.substr(at, end - at);
    const auto number = operations.substr(end, 2) == "mm" ? parseNumber(word) : std::nullopt;
    if (number && *number < 1e9) {
      const std::string rounded = hundredths(*number);
      const bool may = screen || std::fabs(*parseNumber(rounded) - *number) < kNoise;
      all += may ? rounded : std::string(word);
    } else {
      all += word;
    }
    if (end == at) all += operations[end++];
    at = end;
  }
  return all;
}

std::string shortened(const std::string& operation) {
  constexpr std::size_t kMost = 100, kKept = 60;  // bytes of a value
  std::string all;
  for (std::size_t at = 0; at < operation.size();) {
    const std::size_t open = operation.find('"', at);
    if (open == std::string::npos) return all + operation.substr(at);
    std::size_t close = open + 1;
    while (close < operation.size() && operation[close] != '"') close += operation[close] == '\\' ? 2 : 1;
    close = std::min(close, operation.size());
    const std::string value = operation.substr(open + 1, close - open - 1);
    const std::size_t space = value.size() > kMost ? value.rfind(' ', kKept) : std::string::npos;
    all += operation.substr(at, open + 1 - at) + (space == std::string::npos ? value : value.substr(0, space) + " …");
    if (close < operation.size()) all += '"';
    at = close + 1;
  }
  return all;
}

}  // namespace karinui::app
