#pragma once
// Entries of a matrix put in order of row and column, those of one place in the order they came: dealt out to their
// columns first, then to their rows, which is several times quicker than sorting them.
#include <cstdint>
#include <numeric>
#include <vector>

namespace karinui {

// `row`, `column`: what number an entry has, both below `size`.
template <class Entry, class Row, class Column>
void sortByRow(std::vector<Entry>& entries, std::size_t size, const Row& row, const Column& column) {
  std::vector<Entry> dealt(entries.size());
  const auto deal = [&](const auto& number) {
    std::vector<std::uint32_t> next(size + 1, 0);
    for (const Entry& e : entries) ++next[number(e) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Entry& e : entries) dealt[next[number(e)]++] = e;
    entries.swap(dealt);
  };
  deal(column);
  deal(row);
}

}  // namespace karinui
