#pragma once
// A symmetric positive matrix, factored within its envelope: of each row all is kept from its first entry to the
// diagonal, side by side, so that factoring and solving are plain loops. Good where neighbours have numbers near each
// other. Factored in double, solved in float: for who wants a guess, and a quick one.
#include <cstdint>
#include <span>
#include <vector>

namespace karinui {

class Envelope {
 public:
  Envelope() = default;
  explicit Envelope(std::vector<std::uint32_t> first);  // per row, its first column; at most the row itself

  void clear();
  double& at(std::uint32_t row, std::uint32_t column) {  // column from the row's first to the row
    return value_[start_[row] + column - first_[row]];
  }
  bool factor();                         // whether it was positive
  void solve(std::span<float> x) const;  // in: the right-hand side

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::size_t> start_;  // of each row in value_ and low_
  std::vector<double> value_;
  std::vector<float> low_, perDiagonal_;
};

// Numbers for the nodes of a graph such that neighbours' lie near each other (Cuthill and McKee 1969, turned round).
std::vector<std::uint32_t> nearNumbers(const std::vector<std::vector<std::uint32_t>>& around);

}  // namespace karinui
