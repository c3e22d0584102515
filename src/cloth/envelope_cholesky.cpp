#include "cloth/envelope_cholesky.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

template <class Number>
inline Number dotOf(std::size_t count, const Number* __restrict a, const Number* __restrict b) {
  Number lane[kLanes] = {};
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) lane[l] += a[k + l] * b[k + l];
  Number sum = 0;
  for (; k < count; ++k) sum += a[k] * b[k];
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t l = 0; l < half; ++l) lane[l] += lane[l + half];
  return sum + lane[0];
}

struct Rows {
  std::size_t count = 0;
  const std::uint32_t* first = nullptr;
  const std::size_t* start = nullptr;
};

// Cholesky, row by row; false when a diagonal is not positive.
KARINUI_WIDE bool factorRows(const Rows rows, double* value) {
  for (std::size_t i = 0; i < rows.count; ++i) {
    double* row = value + rows.start[i] - rows.first[i];
    for (std::size_t j = rows.first[i]; j <= i; ++j) {
      const double* other = value + rows.start[j] - rows.first[j];
      const std::size_t from = std::max(rows.first[i], rows.first[j]);
      const double left = row[j] - dotOf(j - from, row + from, other + from);
      if (j < i) {
        row[j] = left / other[j];
      } else {
        if (!(left > 0)) return false;
        row[i] = std::sqrt(left);
      }
    }
  }
  return true;
}

KARINUI_WIDE void solveRows(const Rows rows, const float* __restrict value, const float* __restrict perDiagonal,
                            float* __restrict x) {
  for (std::size_t i = 0; i < rows.count; ++i) {
    const std::size_t from = rows.first[i];
    x[i] = (x[i] - dotOf(i - from, value + rows.start[i], x + from)) * perDiagonal[i];
  }
  for (std::size_t i = rows.count; i-- > 0;) {
    const std::size_t from = rows.first[i], count = i - from;
    const float* row = value + rows.start[i];
    const float found = x[i] * perDiagonal[i];
    x[i] = found;
    float* before = x + from;
    KARINUI_APART
    for (std::size_t k = 0; k < count; ++k) before[k] -= row[k] * found;
  }
}

}  // namespace

EnvelopeCholesky::EnvelopeCholesky(std::vector<std::uint32_t> first) : first_(std::move(first)) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    start_.push_back(size);
    size += i + 1 - first_[i];
  }
  value_.assign(size, 0);
  low_.resize(size);
  perDiagonal_.resize(first_.size());
}

void EnvelopeCholesky::clear() { std::fill(value_.begin(), value_.end(), 0.0); }

bool EnvelopeCholesky::factor(double shift) {
  factor_ = value_;
  const auto diagonal = [&](std::size_t i) -> double& { return factor_[start_[i] + i - first_[i]]; };
  for (std::size_t i = 0; i < first_.size(); ++i) diagonal(i) *= 1 + shift;
  if (!factorRows({first_.size(), first_.data(), start_.data()}, factor_.data())) return false;
  std::transform(factor_.begin(), factor_.end(), low_.begin(), [](double v) { return static_cast<float>(v); });
  for (std::size_t i = 0; i < first_.size(); ++i) perDiagonal_[i] = static_cast<float>(1 / diagonal(i));
  return true;
}

void EnvelopeCholesky::solve(std::span<float> x) const {
  solveRows({first_.size(), first_.data(), start_.data()}, low_.data(), perDiagonal_.data(), x.data());
}

std::vector<std::uint32_t> reverseCuthillMcKee(const std::vector<std::vector<std::uint32_t>>& around) {
  const std::size_t count = around.size();
  std::vector<std::uint32_t> order;
  std::vector<std::uint8_t> in(count, 0);
  const auto walk = [&](std::uint32_t from) {  // its component, breadth first
    const std::size_t begin = order.size();
    order.push_back(from);
    in[from] = 1;
    for (std::size_t k = begin; k < order.size(); ++k) {
      const std::size_t ring = order.size();
      for (const std::uint32_t other : around[order[k]])
        if (!in[other]) {
          in[other] = 1;
          order.push_back(other);
        }
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(ring), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return around[a].size() < around[b].size(); });
    }
  };
  for (std::uint32_t node = 0; node < count; ++node) {
    if (in[node]) continue;
    const std::size_t begin = order.size();
    std::uint32_t from = node;
    for (int again = 0; again < 3; ++again) {  // from what lies furthest, so that the rings are narrow
      walk(from);
      if (again == 2) break;
      from = order.back();
      for (std::size_t k = begin; k < order.size(); ++k) in[order[k]] = 0;
      order.resize(begin);
    }
  }
  std::vector<std::uint32_t> number(count);
  for (std::size_t k = 0; k < count; ++k) number[order[k]] = static_cast<std::uint32_t>(count - 1 - k);
  return number;
}

}  // namespace karinui
