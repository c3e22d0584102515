#pragma once
// Sorts entries of a matrix by row and column, stably: a radix sort, by column first and then by row, which is several
// times faster than a comparison sort.
#include <cstdint>
#include <numeric>
#include <vector>

namespace karinui {

// `row`, `column`: what number an entry has, both below `size`.
template <class Entry, class Row, class Column>
void sortByRow(std::vector<Entry>& entries, std::size_t size, const Row& row, const Column& column) {
  std::vector<Entry> sorted(entries.size());
  const auto countingSort = [&](const auto& number) {
    std::vector<std::uint32_t> next(size + 1, 0);
    for (const Entry& e : entries) ++next[number(e) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Entry& e : entries) sorted[next[number(e)]++] = e;
    entries.swap(sorted);
  };
  countingSort(column);
  countingSort(row);
}

}  // namespace karinui
