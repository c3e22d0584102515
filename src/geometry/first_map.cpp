#include "geometry/first_map.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

double totalArea(std::span<const RestTriangle> rest) {
  double sum = 0;
  for (const RestTriangle& t : rest) sum += t.area;
  return sum;
}

}  // namespace

// The conformal energy is the Dirichlet energy of (u, v) less the area of the image; two border points are held.
std::vector<Flat> conformalMap(std::span<const RestTriangle> rest, std::span<const std::uint32_t> border,
                               std::size_t points, std::span<const Vec3> space) {
  // Two far points of the border: the farthest from the first, then the farthest from that.
  const auto farthest = [&](std::uint32_t from) {
    return *std::max_element(border.begin(), border.end(), [&](std::uint32_t a, std::uint32_t b) {
      return distance(space[a], space[from]) < distance(space[b], space[from]);
    });
  };
  const std::uint32_t one = farthest(border[0]), two = farthest(one);
  std::vector<Flat> flat(points);
  flat[one] = {0, 0};
  flat[two] = {distance(space[one], space[two]), 0};

  std::vector<int> unknown(2 * points, -1);
  int count = 0;
  for (std::uint32_t p = 0; p < points; ++p)
    if (p != one && p != two) {
      unknown[2 * p] = count++;
      unknown[2 * p + 1] = count++;
    }
  const auto held = [&](std::size_t x) { return x % 2 == 0 ? flat[x / 2].u : flat[x / 2].v; };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  const auto add = [&](std::size_t row, std::size_t column, double value) {
    if (unknown[row] < 0) return;
    if (unknown[column] < 0) {
      right[unknown[row]] -= value * held(column);
    } else {
      entries.emplace_back(unknown[row], unknown[column], value);
    }
  };
  for (const RestTriangle& t : rest)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double w = t.area * dot(t.gradient[i], t.gradient[j]);
        add(2 * t.corner[i], 2 * t.corner[j], w);
        add(2 * t.corner[i] + 1, 2 * t.corner[j] + 1, w);
      }
  for (std::size_t i = 0; i < border.size(); ++i) {  // less the area: sum of (ua vb - va ub) / 2 round the border
    const std::size_t a = border[i], b = border[(i + 1) % border.size()];
    add(2 * a, 2 * b + 1, -0.5);
    add(2 * b + 1, 2 * a, -0.5);
    add(2 * a + 1, 2 * b, 0.5);
    add(2 * b, 2 * a + 1, 0.5);
  }
  Sparse matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Sparse> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::VectorXd x = solver.solve(right);
  for (std::size_t p = 0; p < points; ++p)
    if (unknown[2 * p] >= 0) flat[p] = {x[unknown[2 * p]], x[unknown[2 * p + 1]]};

  double area = 0;
  for (std::size_t i = 0; i < border.size(); ++i)
    area += 0.5 * cross(flat[border[i]], flat[border[(i + 1) % border.size()]]);
  if (!(area > 0)) return {};
  const double scale = std::sqrt(totalArea(rest) / area);
  for (Flat& p : flat) p = p * scale;
  return flat;
}

std::vector<Flat> tutteMap(std::span<const RestTriangle> rest, std::span<const std::uint32_t> border,
                           std::size_t points, std::span<const Vec3> space) {
  std::vector<Flat> flat(points);
  std::vector<std::uint8_t> onBorder(points, 0);
  double whole = 0, run = 0;
  for (std::size_t i = 0; i < border.size(); ++i)
    whole += distance(space[border[i]], space[border[(i + 1) % border.size()]]);
  const double radius = std::sqrt(totalArea(rest) / std::numbers::pi);
  for (std::size_t i = 0; i < border.size(); ++i) {
    const double angle = 2 * std::numbers::pi * run / whole;
    flat[border[i]] = Flat{std::cos(angle), std::sin(angle)} * radius;
    onBorder[border[i]] = 1;
    run += distance(space[border[i]], space[border[(i + 1) % border.size()]]);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const RestTriangle& t : rest)
    for (std::size_t k = 0; k < 3; ++k)
      edges.emplace_back(std::min(t.corner[k], t.corner[(k + 1) % 3]), std::max(t.corner[k], t.corner[(k + 1) % 3]));
  sortOnce(edges);

  std::vector<int> unknown(points, -1);
  int count = 0;
  for (std::size_t p = 0; p < points; ++p)
    if (!onBorder[p]) unknown[p] = count++;
  if (count == 0) return flat;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
  for (const auto& edge : edges)
    for (const auto& [a, b] : {edge, std::pair{edge.second, edge.first}}) {
      if (unknown[a] < 0) continue;
      entries.emplace_back(unknown[a], unknown[a], 1.0);
      if (unknown[b] >= 0) {
        entries.emplace_back(unknown[a], unknown[b], -1.0);
      } else {
        right(unknown[a], 0) += flat[b].u;
        right(unknown[a], 1) += flat[b].v;
      }
    }
  Sparse matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Sparse> solver(matrix);
  const Eigen::MatrixX2d x = solver.solve(right);
  for (std::size_t p = 0; p < points; ++p)
    if (unknown[p] >= 0) flat[p] = {x(unknown[p], 0), x(unknown[p], 1)};
  return flat;
}

}  // namespace karinui
