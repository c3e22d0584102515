#include "readable_lengths.h"

#include <unistd.h>

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

}  // namespace karinui::app
