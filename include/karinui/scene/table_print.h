#pragma once
// A print as it lies on a piece's paper on the table, in shapes that whoever paints the table cuts off at the piece's
// outline. Pure; any thread. Metres on the table.
#include <array>
#include <vector>

#include "karinui/scene/table_frame.h"

namespace karinui {

struct TablePrint {
  std::vector<TableStroke> stripes;
  double stripe = 0;  // as wide as this
  std::vector<Flat> dots;
  double dot = 0;                           // their radius
  std::vector<std::array<Flat, 3>> photos;  // of each its upper left, upper right and lower left corner
  double strength = 0;                      // opacity it is seen with on paper
};
// Nothing where so many repeats would lie on the piece that they could not be told apart.
TablePrint printOn(const TablePiece& piece);

}  // namespace karinui
