#pragma once
// Entries of a matrix put in order of row and column, those of one place in the order they came. Rows are short, so
// dealing the entries out to their rows first is several times quicker than sorting them all.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace karinui {

// `row`, `column`: what number an entry has; rows are below `rows`.
template <class Entry, class Row, class Column>
void sortByRow(std::vector<Entry>& entries, std::size_t rows, const Row& row, const Column& column) {
  std::vector<std::uint32_t> start(rows + 1, 0);
  for (const Entry& e : entries) ++start[row(e) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Entry> dealt(entries.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (const Entry& e : entries) dealt[next[row(e)]++] = e;
  for (std::size_t r = 0; r < rows; ++r)
    std::stable_sort(dealt.begin() + start[r], dealt.begin() + start[r + 1],
                     [&](const Entry& a, const Entry& b) { return column(a) < column(b); });
  entries = std::move(dealt);
}

}  // namespace karinui
