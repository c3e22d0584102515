#include "karinui/base/near_names.h"

#include <algorithm>

namespace karinui {

std::size_t edits(std::string_view a, std::string_view b) {  // Levenshtein
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, corner + (a[i - 1] != b[j - 1])});
      corner = above;
    }
  }
  return row.back();
}

std::size_t mostEdits(std::string_view wanted) { return std::max<std::size_t>(1, wanted.size() / 3); }

std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& names) {
  std::vector<std::string> near;
  for (const std::string& name : names)
    if (edits(wanted, name) <= mostEdits(wanted)) near.push_back(name);
  std::stable_sort(near.begin(), near.end(),
                   [&](const std::string& a, const std::string& b) { return edits(wanted, a) < edits(wanted, b); });
  near.resize(std::min<std::size_t>(3, near.size()));
  return near;
}

}  // namespace karinui
