#pragma once
// The whole figure as one smooth distance field on a grid, left and right alike: tubes joined by a smooth minimum whose
// roundness depends on how the surfaces meet, softened at the armscye and the crotch.
#include <vector>

#include "body/figure.h"
#include "karinui/base/workers.h"

namespace karinui {

// Cell corners of the left half; the right half is its mirror image: corner i of the half stands at x = (i + 0.5) cell.
// Not mirrored: all there is.
struct FieldGrid {
  double cell = 0.011;
  double lowY = 0, lowZ = 0;
  bool mirrored = true;
  std::size_t nx = 0, ny = 0, nz = 0;  // of the half
  std::vector<float> value;            // [(x * ny + y) * nz + z], negative inside
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return (x * ny + y) * nz + z; }
  Vec3 place(std::size_t x, std::size_t y, std::size_t z) const {
    return {(static_cast<double>(x) + 0.5) * cell, lowY + static_cast<double>(y) * cell,
            lowZ + static_cast<double>(z) * cell};
  }
};

// `shift` in [0, 1) moves the grid by that share of a cell: another try where one meets awkwardly with the surface.
FieldGrid fieldOf(const Figure& figure, double cell, double shift, Workers& workers);

}  // namespace karinui
