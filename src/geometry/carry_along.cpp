#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>

#include "karinui/base/sort_once.h"

#include "karinui/geometry/flatten.h"

namespace karinui {

std::vector<Flat> carryAlong(std::span<const Flat> flat, std::span<const Triangle> faces,
                             std::span<const Carried> held) {
  std::vector<Flat> by(flat.size());
  std::vector<int> unknown(flat.size(), 0);
  for (const Carried& c : held) {
    by[c.point] = c.by;
    unknown[c.point] = -1;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // those that have an unknown end
  std::vector<std::uint8_t> used(flat.size(), 0);
  for (const Triangle& t : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      used[a] = 1;
      if (unknown[a] == 0 || unknown[b] == 0) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  sortOnce(edges);
  int count = 0;
  for (std::size_t p = 0; p < flat.size(); ++p)
    if (unknown[p] == 0) unknown[p] = used[p] ? count++ : -1;
  if (count > 0 && !held.empty()) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, 1e-9);  // a part that nothing holds stays
    for (const auto& edge : edges)
      for (const auto& [a, b] : {edge, std::pair{edge.second, edge.first}}) {
        if (unknown[a] < 0) continue;
        entries.emplace_back(unknown[a], unknown[a], 1.0);
        if (unknown[b] >= 0) {
          entries.emplace_back(unknown[a], unknown[b], -1.0);
        } else {
          right(unknown[a], 0) += by[b].u;
          right(unknown[a], 1) += by[b].v;
        }
      }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::MatrixX2d x = solver.solve(right);
    for (std::size_t p = 0; p < flat.size(); ++p)
      if (unknown[p] >= 0) by[p] = {x(unknown[p], 0), x(unknown[p], 1)};
  }
  std::vector<Flat> out(flat.begin(), flat.end());
  for (std::size_t p = 0; p < flat.size(); ++p) out[p] += by[p];
  return out;
}

}  // namespace karinui
