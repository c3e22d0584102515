#pragma once
// Nodes sorted into the cells of a box around them (a cell list).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth_topology.h"

namespace karinui {

struct CellList {
  Vec3 low;
  double side = 1;  // of a cell, metres
  std::array<std::int64_t, 3> count{};
  Incidence nodes;          // of each cell
  std::vector<Vec3> place;  // of each item of `nodes`

  CellList() = default;
  // At least one place. Cells are larger than asked where there would be too many.
  CellList(std::span<const Vec3> x, double side);

  std::array<std::int64_t, 3> at(Vec3 p) const {
    return {static_cast<std::int64_t>((p.x - low.x) / side), static_cast<std::int64_t>((p.y - low.y) / side),
            static_cast<std::int64_t>((p.z - low.z) / side)};
  }
  std::size_t number(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * count[1] + j) * count[0] + i);
  }
};

}  // namespace karinui
