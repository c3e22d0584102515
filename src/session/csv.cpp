#include "session/csv.h"

namespace karinui {

std::string csvRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) row += ',';
    if (cells[k].find_first_of(",\"\r\n") == std::string::npos) {
      row += cells[k];
      continue;
    }
    row += '"';
    for (const char c : cells[k]) row += c == '"' ? std::string("\"\"") : std::string(1, c);
    row += '"';
  }
  return row + "\r\n";
}

}  // namespace karinui
