#pragma once
// The grid of coarse nodes that a piece's lattice is interpolated from, by quadratic B-splines along each side
// (de Boor: A Practical Guide to Splines, 1978). Bending goes with the second derivative of a move: where a bilinear
// interpolation has a kink all of the bending falls on one cell, and the finer the cells are, the stiffer the coarse
// matrix takes long waves for.
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cloth/grid_layout.h"

namespace karinui {

// Coarse cells along one side of a piece's grid. All are of equally many fine lines: were they not, the splines would
// have kinks between them. So the last one may reach beyond the grid.
struct CoarseLines {
  using Weights = std::array<double, 3>;
  std::uint32_t each = 1;                    // fine lines in a cell
  std::vector<std::uint32_t> at;             // the fine lines at which cells begin, and the grid's last line
  std::vector<std::uint32_t> cell;           // per fine line: the cell it lies in,
  std::array<std::vector<float>, 3> weight;  // and there the splines of this number and the next two; padded

  CoarseLines(std::uint32_t fine, double about);               // so many fine lines in a cell, one more or one fewer
  std::pair<std::uint32_t, Weights> place(double fine) const;  // cell and weights at any place
  std::uint32_t splines() const { return static_cast<std::uint32_t>(at.size()) + 1; }
};

struct CoarseGrid {
  const GridBlock* block = nullptr;  // null: all its nodes are unstructured
  CoarseLines column, row;
  std::uint32_t first = 0;  // coarse node
  std::uint32_t columns() const { return column.splines(); }
  std::uint32_t rows() const { return row.splines(); }
};

struct CoarseWeight {
  std::uint32_t node = 0;  // coarse
  float weight = 0;
};
using CoarseStencil = std::array<CoarseWeight, 9>;  // what a place moves with
CoarseStencil stencilAt(const CoarseGrid& grid, double column, double row);

}  // namespace karinui
