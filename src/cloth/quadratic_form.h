#pragma once
// A quadratic form x^T A x / 2 over the nodes of a piece, kept as the few-node terms it is the sum of. The rows of A
// are found one by one: a list of all entries, from which they would be sorted, is twenty times as long as A.
#include <cstdint>
#include <span>
#include <vector>

namespace karinui {

// One row of a sparse matrix while it is added up.
class SparseRowSum {
 public:
  explicit SparseRowSum(std::size_t columns) : value_(columns, 0), has_(columns, 0) {}
  void add(std::uint32_t column, double value) {
    if (!has_[column]) {
      has_[column] = 1;
      columns_.push_back(column);
    }
    value_[column] += value;
  }
  // Calls visit(column, value) for what was added, by column, and clears the row.
  template <class Visit>
  void take(Visit visit) {
    sortColumns();
    for (const std::uint32_t column : columns_) {
      visit(column, value_[column]);
      value_[column] = 0;
      has_[column] = 0;
    }
    columns_.clear();
  }

 private:
  void sortColumns();
  std::vector<double> value_;
  std::vector<std::uint8_t> has_;
  std::vector<std::uint32_t> columns_;
};

class QuadraticForm {
 public:
  explicit QuadraticForm(std::size_t nodes) : nodes_(nodes) {}
  // c (w . x)^2 / 2; nothing where c is not positive.
  void addSquare(std::span<const std::uint32_t> nodes, const double* w, double c);
  // c x^T m x / 2, `m` column after column.
  void addBlock(std::span<const std::uint32_t> nodes, const double* m, double c);
  void sortByNode();  // when all terms are added, before the first row
  // Adds A's row of a node, in the order in which its terms were added.
  void addRow(std::uint32_t node, SparseRowSum& sum) const;

 private:
  struct Term {
    std::uint32_t begin = 0, count = 0;  // in node_
    std::size_t values = 0;              // in value_: as many, or of a block their square
    double c = 0;
    bool block = false;
  };
  struct Place {
    std::uint32_t term = 0, at = 0;
  };
  void addTerm(std::span<const std::uint32_t> nodes, const double* values, std::size_t count, double c, bool block);

  std::size_t nodes_;
  std::vector<Term> terms_;
  std::vector<std::uint32_t> node_;
  std::vector<double> value_;
  std::vector<std::uint32_t> start_;  // of each node in place_, and one past the last
  std::vector<Place> place_;          // where a node stands in the terms, in their order
};

}  // namespace karinui
