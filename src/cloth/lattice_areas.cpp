#include "cloth/lattice_areas.h"

#include <algorithm>

#include "karinui/base/sort_once.h"

namespace karinui {

LatticeAreas latticeAreas(const Lattice& lattice) {
  LatticeAreas areas;
  const std::size_t count = lattice.nodes.size();
  areas.cell.assign(count, 0);
  areas.ring.assign(count, 0);
  areas.stencil.assign(count, {kNoNode, kNoNode, kNoNode, kNoNode});
  const std::uint32_t columns = lattice.columns, rows = lattice.rows;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return lattice.grid[std::size_t{j} * columns + i]; };
  const auto whole = [&](std::uint32_t i, std::uint32_t j) {
    return lattice.cell[std::size_t{j} * (columns - 1) + i] != 0;
  };
  std::vector<std::array<std::int64_t, 2>> place(count, {-1, -1});
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i)
      if (at(i, j) != kNoNode) place[at(i, j)] = {i, j};
  const double quarter = lattice.spacing * lattice.spacing / 4;
  for (std::uint32_t j = 0; j + 1 < rows; ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i)
      if (whole(i, j)) {
        areas.corners.push_back({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        for (std::uint32_t k : areas.corners.back()) areas.cell[k] += quarter;
      }
  for (std::uint32_t j = 1; j + 1 < rows; ++j)
    for (std::uint32_t i = 1; i + 1 < columns; ++i)
      if (whole(i - 1, j - 1) && whole(i, j - 1) && whole(i - 1, j) && whole(i, j))
        areas.stencil[at(i, j)] = {at(i - 1, j), at(i + 1, j), at(i, j - 1), at(i, j + 1)};
  for (std::uint32_t f = 0; f < lattice.faces.size(); ++f) {
    const Triangle& face = lattice.faces[f];
    // A face of a whole cell has its three corners on that cell's grid points.
    std::int64_t i = place[face[0]][0], j = place[face[0]][1];
    bool onGrid = true;
    for (std::uint32_t k : face) {
      onGrid = onGrid && place[k][0] >= 0;
      i = std::min(i, place[k][0]);
      j = std::min(j, place[k][1]);
    }
    for (std::uint32_t k : face) onGrid = onGrid && place[k][0] - i <= 1 && place[k][1] - j <= 1;
    if (onGrid && i + 1 < columns && j + 1 < rows &&
        whole(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)))
      continue;
    const Flat a = lattice.nodes[face[0]];
    const double third = cross(lattice.nodes[face[1]] - a, lattice.nodes[face[2]] - a) / 6;
    if (!(third > 0)) continue;
    areas.ringFaces.push_back(f);
    for (std::uint32_t k : face) areas.ring[k] += third;
  }
  return areas;
}

std::vector<std::vector<std::uint32_t>> neighboursOf(std::size_t nodes, const std::vector<Triangle>& faces) {
  std::vector<std::vector<std::uint32_t>> near(nodes);
  for (const Triangle& face : faces)
    for (int a = 0; a < 3; ++a) {
      near[face[a]].push_back(face[(a + 1) % 3]);
      near[face[a]].push_back(face[(a + 2) % 3]);
    }
  for (auto& list : near) {
    sortOnce(list);
  }
  return near;
}

}  // namespace karinui
