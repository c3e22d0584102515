#pragma once
// How much nearer to each other nodes may have come since some moment, and may come in a move: bounded for each two
// cells of the space where they stood then. Cloth that goes along as a whole comes no nearer to itself.
#include <span>
#include <vector>

#include "cloth/cell_list.h"

namespace karinui {

class ApproachBound {
 public:
  // Places now; `side`: of the cells, metres.
  void make(std::span<const Vec3> x, double side);

  // Of pairs that stood `listed` metres apart at least: by how much more than is allowed one may come nearer to each
  // other, if none is to end nearer than `reach`. Not positive: none does. x: where the nodes stand; move: where they
  // may go from there, counted `share` times, or empty.
  struct Motion {
    std::span<const Vec3> x, move;
    double share = 1;
  };
  double excess(const Motion& motion, double listed, double reach) const;

 private:
  struct Cell {
    std::array<std::int64_t, 3> at{};
    std::uint32_t number = 0;  // in the list
  };
  struct Ways {  // of a cell's nodes
    Vec3 low, high;
    double most = 0;
  };
  static Ways waysOf(std::span<const std::uint32_t> nodes, std::span<const Vec3> to, std::span<const Vec3> from);
  static double parted(const Ways& a, const Ways& b);

  CellList list_;
  std::vector<Vec3> from_;
  std::vector<Cell> cells_;           // that have nodes
  std::vector<std::uint32_t> index_;  // of each cell of the list, among them; kNoNode: it has none
};

}  // namespace karinui
