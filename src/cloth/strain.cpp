#include "cloth/strain.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

// visit(piece, length now as a share of its length at rest, middle)
template <class Visit>
void eachThread(const Cloth& cloth, std::span<const Vec3> x, const Visit& visit) {
  for (const ClothPiece& piece : cloth.pieces) {
    const Lattice& lattice = *piece.lattice;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
      if (a == kNoNode || b == kNoNode) return;
      const double rest = distance(lattice.nodes[a], lattice.nodes[b]);
      const Vec3 from = x[piece.firstNode + a], to = x[piece.firstNode + b];
      if (rest > 0) visit(piece, distance(from, to) / rest, (from + to) * 0.5);
    };
    const std::size_t columns = lattice.columns, rows = lattice.rows;
    const auto whole = [&](std::size_t i, std::size_t j) {
      return i + 1 < columns && j + 1 < rows && lattice.cell[j * (columns - 1) + i] != 0;
    };
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) {
        if (i + 1 < columns && (whole(i, j) || (j > 0 && whole(i, j - 1))))
          add(lattice.grid[j * columns + i], lattice.grid[j * columns + i + 1]);
        if (j + 1 < rows && (whole(i, j) || (i > 0 && whole(i - 1, j))))
          add(lattice.grid[j * columns + i], lattice.grid[(j + 1) * columns + i]);
      }
  }
}

}  // namespace

DrawnOut mostDrawnOut(const Cloth& cloth, std::span<const Vec3> x) {
  DrawnOut most;
  eachThread(cloth, x, [&](const ClothPiece& piece, double times, Vec3 place) {
    if (times > most.times) most = {&piece, times, place};
  });
  return most;
}

StrainReport strainOf(const Cloth& cloth, std::span<const Vec3> x) {
  std::vector<double> strain;
  eachThread(cloth, x, [&](const ClothPiece&, double times, Vec3) { strain.push_back(std::fabs(times - 1)); });
  StrainReport report;
  if (strain.empty()) return report;
  std::sort(strain.begin(), strain.end());
  for (double s : strain) report.mean += s;
  report.mean /= static_cast<double>(strain.size());
  report.p99 = strain[std::min(strain.size() - 1, strain.size() * 99 / 100)];
  report.max = strain.back();
  return report;
}

}  // namespace karinui
