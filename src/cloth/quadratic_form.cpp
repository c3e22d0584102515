#include "cloth/quadratic_form.h"

#include <algorithm>
#include <numeric>

namespace karinui {

void SparseRowSum::sortColumns() { std::sort(columns_.begin(), columns_.end()); }

void QuadraticForm::addTerm(std::span<const std::uint32_t> nodes, const double* values, std::size_t count, double c,
                            bool block) {
  terms_.push_back(
      {static_cast<std::uint32_t>(node_.size()), static_cast<std::uint32_t>(nodes.size()), value_.size(), c, block});
  node_.insert(node_.end(), nodes.begin(), nodes.end());
  value_.insert(value_.end(), values, values + count);
}

void QuadraticForm::addSquare(std::span<const std::uint32_t> nodes, const double* w, double c) {
  if (c > 0) addTerm(nodes, w, nodes.size(), c, false);
}

void QuadraticForm::addBlock(std::span<const std::uint32_t> nodes, const double* m, double c) {
  addTerm(nodes, m, nodes.size() * nodes.size(), c, true);
}

void QuadraticForm::sortByNode() {
  start_.assign(nodes_ + 1, 0);
  for (const std::uint32_t node : node_) ++start_[node + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  place_.resize(node_.size());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::uint32_t t = 0; t < terms_.size(); ++t)
    for (std::uint32_t k = 0; k < terms_[t].count; ++k) place_[next[node_[terms_[t].begin + k]]++] = {t, k};
}

void QuadraticForm::addRow(std::uint32_t node, SparseRowSum& sum) const {
  for (std::uint32_t p = start_[node]; p < start_[node + 1]; ++p) {
    const Term& term = terms_[place_[p].term];
    const std::uint32_t* column = node_.data() + term.begin;
    const double* value = value_.data() + term.values;
    if (term.block) {
      for (std::uint32_t b = 0; b < term.count; ++b)
        sum.add(column[b], term.c * value[std::size_t{b} * term.count + place_[p].at]);
      continue;
    }
    const double own = value[place_[p].at];
    if (own == 0) continue;
    for (std::uint32_t b = 0; b < term.count; ++b)
      if (value[b] != 0) sum.add(column[b], term.c * own * value[b]);
  }
}

}  // namespace karinui
