#pragma once
// Evenly spaced points of a box: where they are and how they are numbered.
#include <array>
#include <cstddef>

#include "karinui/geometry/vec.h"

namespace karinui {

using Count = std::array<std::size_t, 3>;

// Numbered x first.
struct SpacedGrid {
  Vec3 origin;
  double step = 0;
  Count count{};
  std::size_t points() const { return count[0] * count[1] * count[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * count[1] + j) * count[0] + i; }
  Count split(std::size_t n, std::size_t times) const {  // an index into its three, so many times
    return {n % count[0] * times, n / count[0] % count[1] * times, n / (count[0] * count[1]) * times};
  }
  Vec3 place(std::size_t i, std::size_t j, std::size_t k) const {
    return {origin.x + step * static_cast<double>(i), origin.y + step * static_cast<double>(j),
            origin.z + step * static_cast<double>(k)};
  }
};

}  // namespace karinui
