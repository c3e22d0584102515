#pragma once
// Cholesky factorisation of a symmetric positive matrix within its envelope (skyline): of each row everything is stored
// from its first entry to the diagonal, so that factoring and solving are plain loops. Efficient where neighbours have
// numbers near each other. Factored in double, solved in float: for preconditioners.
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/base/workers.h"

namespace karinui {

class EnvelopeCholesky {
 public:
  EnvelopeCholesky() = default;
  explicit EnvelopeCholesky(std::vector<std::uint32_t> first);  // per row, its first column; at most the row itself

  void clear();
  bool stores(std::uint32_t row, std::uint32_t column) const { return column >= first_[row]; }  // column up to the row
  double& at(std::uint32_t row, std::uint32_t column) {  // column from the row's first to the row
    return value_[start_[row] + column - first_[row]];
  }
  bool factor(Workers& workers, double shift = 0);  // with its diagonal times 1 + shift; whether that was positive
  void solve(std::span<float> x) const;             // in: the right-hand side

 private:
  // Columns that are eliminated at once, first from the rows of the same numbers, then by all threads from the rows
  // below. Numbers of groups: rows that are taken together.
  struct Panel {
    std::uint32_t begin = 0, end = 0, reach = 0;  // `reach`: past the last group that has an entry in these columns
  };
  void findPanels();

  std::vector<std::uint32_t> first_;
  std::vector<std::size_t> start_;    // of each row in value_ and low_
  std::vector<std::uint32_t> group_;  // the first row of each, and one past the last row
  std::vector<Panel> panels_;
  std::vector<double> value_, factor_;
  std::vector<float> low_, perDiagonal_;
};

// Reverse Cuthill-McKee numbers for the nodes of a graph, by which neighbours' numbers lie near each other.
std::vector<std::uint32_t> reverseCuthillMcKee(const std::vector<std::vector<std::uint32_t>>& around);

}  // namespace karinui
