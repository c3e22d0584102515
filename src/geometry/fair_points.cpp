#include "karinui/geometry/fair_points.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>
#include <numbers>

#include "karinui/base/result.h"

namespace karinui {

// Third differences as springs, points held by the weight one: what is least is s sum |p'''|^2 + sum |p - was|^2. A
// wave of length l, points h apart, is left by 1 / (1 + s (2 pi h / l)^6) of its height.
std::vector<Flat> withoutWaves(std::span<const Flat> points, double shortest, KeptDirections kept) {
  constexpr double kThird[] = {-1, 3, -3, 1};
  const std::size_t n = points.size();
  KARINUI_ASSERT(n >= 4 && shortest > 0);
  double length = 0;
  for (std::size_t k = 1; k < n; ++k) length += distance(points[k - 1], points[k]);
  if (!(length > 0)) return {points.begin(), points.end()};
  const double stiff = std::pow(shortest * static_cast<double>(n - 1) / (2 * std::numbers::pi * length), 6);

  // Of the points that move, by their number among them.
  const std::size_t first = kept.atStart ? 2 : 1, last = n - (kept.atEnd ? 2 : 1);  // one past
  if (first >= last) return {points.begin(), points.end()};
  const auto count = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixX2d right(count, 2);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = first; k < last; ++k) {
    const auto row = static_cast<Eigen::Index>(k - first);
    entries.emplace_back(row, row, 1.0);
    right.row(row) << points[k].u, points[k].v;
  }
  for (std::size_t k = 0; k + 3 < n; ++k)
    for (std::size_t i = 0; i < 4; ++i) {
      if (k + i < first || k + i >= last) continue;
      const auto row = static_cast<Eigen::Index>(k + i - first);
      for (std::size_t j = 0; j < 4; ++j) {
        const double weight = stiff * kThird[i] * kThird[j];
        if (k + j >= first && k + j < last)
          entries.emplace_back(row, static_cast<Eigen::Index>(k + j - first), weight);
        else
          right.row(row) -= weight * Eigen::RowVector2d(points[k + j].u, points[k + j].v);
      }
    }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::MatrixX2d found = solver.solve(right);
  std::vector<Flat> fair(points.begin(), points.end());
  for (std::size_t k = first; k < last; ++k) {
    const auto row = static_cast<Eigen::Index>(k - first);
    fair[k] = {found(row, 0), found(row, 1)};
  }
  return fair;
}

}  // namespace karinui
