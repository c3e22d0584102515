#include "cloth/envelope_cholesky.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

// Inlined whatever their size: else they would have the width of the default.
template <class Number>
[[gnu::always_inline]] inline Number dotOf(std::size_t count, const Number* __restrict a, const Number* __restrict b) {
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

constexpr std::size_t kTogether = 3;  // rows: the axes of a node begin in one column
constexpr std::size_t kPanel = 48;    // columns
constexpr std::size_t kGroups = 4;    // rows taken together, a piece of a thread's work

// The two sums of dotOf for each of `a` with b, over lanes and over what is left behind the last whole ones, side by
// side: by itself each dot product waits for its own sums.
template <class Number>
[[gnu::always_inline]] inline void dotsOf(std::size_t count, const Number* const* a, const Number* __restrict b,
                                          Number* over, Number* left) {
  const Number* __restrict a0 = a[0], * __restrict a1 = a[1], * __restrict a2 = a[2];
  Number lane0[kLanes] = {}, lane1[kLanes] = {}, lane2[kLanes] = {}, left0 = 0, left1 = 0, left2 = 0;
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) {
      lane0[l] += a0[k + l] * b[k + l];
      lane1[l] += a1[k + l] * b[k + l];
      lane2[l] += a2[k + l] * b[k + l];
    }
  for (; k < count; ++k) left0 += a0[k] * b[k], left1 += a1[k] * b[k], left2 += a2[k] * b[k];
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t l = 0; l < half; ++l) {
      lane0[l] += lane0[l + half];
      lane1[l] += lane1[l + half];
      lane2[l] += lane2[l + half];
    }
  over[0] = lane0[0], over[1] = lane1[0], over[2] = lane2[0];
  left[0] = left0, left[1] = left1, left[2] = left2;
}

// Whether three rows from i on begin in one column.
inline bool areTogether(const Rows& rows, std::size_t i) {
  return i + kTogether <= rows.count && rows.first[i + 1] == rows.first[i] && rows.first[i + 2] == rows.first[i];
}

// The columns of some rows between `begin` and `end`, which is not past the first of them. The rows of these numbers
// are done.
KARINUI_WIDE void eliminate(const Rows rows, std::size_t i, std::size_t taken, std::size_t begin, std::size_t end,
                            double* value) {
  const std::size_t first = rows.first[i];
  double* row[kTogether];
  for (std::size_t r = 0; r < taken; ++r) row[r] = value + rows.start[i + r] - rows.first[i + r];
  for (std::size_t j = std::max(first, begin); j < end; ++j) {
    const double* other = value + rows.start[j] - rows.first[j];
    const std::size_t from = std::max<std::size_t>(first, rows.first[j]);
    if (taken == kTogether) {
      const double* const a[kTogether] = {row[0] + from, row[1] + from, row[2] + from};
      double over[kTogether], left[kTogether];
      dotsOf(j - from, a, other + from, over, left);
      for (std::size_t r = 0; r < kTogether; ++r) row[r][j] = (row[r][j] - (left[r] + over[r])) / other[j];
    } else {
      row[0][j] = (row[0][j] - dotOf(j - from, row[0] + from, other + from)) / other[j];
    }
  }
}

// Their columns from the first of them on; false when a diagonal is not positive.
KARINUI_WIDE bool finish(const Rows rows, std::size_t i, std::size_t taken, double* value) {
  for (std::size_t r = 0; r < taken; ++r) {
    double* row = value + rows.start[i + r] - rows.first[i + r];
    for (std::size_t j = i; j <= i + r; ++j) {
      const double* other = value + rows.start[j] - rows.first[j];
      const std::size_t from = std::max<std::size_t>(rows.first[i], rows.first[j]);
      const double left = row[j] - dotOf(j - from, row + from, other + from);
      if (j < i + r) {
        row[j] = left / other[j];
      } else {
        if (!(left > 0)) return false;
        row[j] = std::sqrt(left);
      }
    }
  }
  return true;
}

KARINUI_WIDE void solveRows(const Rows rows, const float* __restrict value, const float* __restrict perDiagonal,
                            float* __restrict x) {
  for (std::size_t i = 0; i < rows.count;) {
    const std::size_t from = rows.first[i], count = i - from;
    // The last of three rows is longer by two, which are not to fill its lanes.
    if (areTogether(rows, i) && count % kLanes + kTogether <= kLanes) {
      const float* const row[kTogether] = {value + rows.start[i], value + rows.start[i + 1], value + rows.start[i + 2]};
      float over[kTogether], left[kTogether];
      dotsOf(count, row, x + from, over, left);
      for (std::size_t r = 0; r < kTogether; ++r) {
        for (std::size_t k = 0; k < r; ++k) left[r] += row[r][count + k] * x[i + k];
        x[i + r] = (x[i + r] - (left[r] + over[r])) * perDiagonal[i + r];
      }
      i += kTogether;
    } else {
      x[i] = (x[i] - dotOf(count, value + rows.start[i], x + from)) * perDiagonal[i];
      ++i;
    }
  }
  for (std::size_t i = rows.count; i > 0;) {
    if (i >= kTogether && areTogether(rows, i - kTogether)) {
      i -= kTogether;
      const std::size_t from = rows.first[i], count = i - from;
      const float* __restrict a = value + rows.start[i], * __restrict b = value + rows.start[i + 1], * __restrict c = value + rows.start[i + 2];
      const float z = x[i + 2] * perDiagonal[i + 2];
      const float y = (x[i + 1] - c[count + 1] * z) * perDiagonal[i + 1];
      const float w = ((x[i] - c[count] * z) - b[count] * y) * perDiagonal[i];
      x[i] = w, x[i + 1] = y, x[i + 2] = z;
      float* before = x + from;
      KARINUI_APART
      for (std::size_t k = 0; k < count; ++k) before[k] = ((before[k] - c[k] * z) - b[k] * y) - a[k] * w;
    } else {
      --i;
      const std::size_t from = rows.first[i], count = i - from;
      const float* row = value + rows.start[i];
      const float found = x[i] * perDiagonal[i];
      x[i] = found;
      float* before = x + from;
      KARINUI_APART
      for (std::size_t k = 0; k < count; ++k) before[k] -= row[k] * found;
    }
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
  findPanels();
}

void EnvelopeCholesky::findPanels() {
  const Rows rows{first_.size(), first_.data(), start_.data()};
  for (std::size_t i = 0; i < rows.count; i += areTogether(rows, i) ? kTogether : 1)
    group_.push_back(static_cast<std::uint32_t>(i));
  group_.push_back(static_cast<std::uint32_t>(rows.count));
  const auto groups = static_cast<std::uint32_t>(group_.size() - 1);
  for (std::uint32_t begin = 0, end = 0; begin < groups; begin = end) {
    for (end = begin + 1; end < groups && group_[end + 1] - group_[begin] <= kPanel;) ++end;
    panels_.push_back({begin, end, end});
  }
  for (std::uint32_t g = 0; g < groups; ++g)
    for (auto panel = panels_.rbegin(); panel != panels_.rend() && group_[panel->end] > first_[group_[g]]; ++panel)
      panel->reach = std::max(panel->reach, g + 1);
}

void EnvelopeCholesky::clear() { std::fill(value_.begin(), value_.end(), 0.0); }

bool EnvelopeCholesky::factor(Workers& workers, double shift) {
  factor_ = value_;
  const auto diagonal = [&](std::size_t i) -> double& { return factor_[start_[i] + i - first_[i]]; };
  for (std::size_t i = 0; i < first_.size(); ++i) diagonal(i) *= 1 + shift;
  const Rows rows{first_.size(), first_.data(), start_.data()};
  const auto rowsOf = [&](std::size_t g) { return std::size_t{group_[g + 1] - group_[g]}; };
  for (const Panel& panel : panels_) {
    const std::size_t begin = group_[panel.begin], end = group_[panel.end];
    for (std::size_t g = panel.begin; g < panel.end; ++g) {
      eliminate(rows, group_[g], rowsOf(g), begin, group_[g], factor_.data());
      if (!finish(rows, group_[g], rowsOf(g), factor_.data())) return false;
    }
    workers.forBlocks(panel.reach - panel.end, kGroups, [&](std::size_t from, std::size_t to) {
      for (std::size_t g = panel.end + from; g < panel.end + to; ++g)
        eliminate(rows, group_[g], rowsOf(g), begin, end, factor_.data());
    });
  }
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
