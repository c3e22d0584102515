#pragma once
// Rows of words for a terminal, their columns aligned.
#include <algorithm>
#include <string>
#include <vector>

namespace karinui::app {

// Columns on a screen: letters of Chinese and Japanese take two.
inline std::size_t columns(const std::string& words) {
  std::size_t wide = 0;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    wide += byte < 0x80 ? 1 : byte >= 0xE3 ? 2 : byte >= 0xC0 ? 1 : 0;
  }
  return wide;
}

// The last column is not padded.
class WordTable {
 public:
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  std::string words(std::size_t indent) const {
    std::vector<std::size_t> wide;
    for (const auto& cells : rows_)
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i == wide.size()) wide.push_back(0);
        wide[i] = std::max(wide[i], columns(cells[i]));
      }
    std::string all;
    for (const auto& cells : rows_) {
      all += std::string(indent, ' ');
      for (std::size_t i = 0; i < cells.size(); ++i)
        all += cells[i] + (i + 1 == cells.size() ? "\n" : std::string(wide[i] - columns(cells[i]) + 2, ' '));
    }
    return all;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace karinui::app
