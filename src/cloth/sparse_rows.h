#pragma once
// The part of the step's matrix that lies in no grid block, in compressed rows: 3x3 blocks of the ring, of springs and
// of simcloth, new each step, and scalar weights of the border's bending, which stay. Rows and columns are slots; what
// is on the diagonal is handed over.
#include <span>
#include <vector>

#include "cloth/grid_product.h"

namespace karinui {

struct NodeWeight {
  NodeIndex row = 0, column = 0;
  double weight = 0;  // N/m, the same on all three axes
};

class SparseRows {
 public:
  SparseRows(std::span<const std::uint32_t> slotOf, std::span<const NodePair> pairs,
             std::span<const NodeWeight> weights);
  void assemble(std::span<const Block3> blocks, DiagonalBlocks& own, Workers& workers);  // one block per pair
  // A product, in two passes over the ranges: p is loaded from all of them, then q is added to.
  void load(const SlotVectors& p, std::size_t begin, std::size_t end);
  void multiply(std::size_t begin, std::size_t end, SlotVectors& q) const;
  // Calls visit(slot, block) for what a slot's row has in other columns.
  template <class Visit>
  void forRow(std::size_t slot, Visit visit) const {
    const std::size_t row = rowAt(slot);
    if (row == slot_.size() || slot_[row] != slot) return;
    for (std::uint32_t k = rows_[row].firstBlock; k < rows_[row + 1].firstBlock; ++k) {
      const Columns& c = block_[k];
      if (k != ownBlock_[row])
        visit(slot_[blockColumn_[k]], Block3{c.x[0], c.y[0], c.z[0], c.x[1], c.y[1], c.z[1], c.x[2], c.y[2], c.z[2]});
    }
    for (std::uint32_t k = rows_[row].firstWeight; k < rows_[row + 1].firstWeight; ++k)
      visit(slot_[weightColumn_[k]], Block3{weight_[k], 0, 0, 0, weight_[k], 0, 0, 0, weight_[k]});
  }
  // Blocks and weights in the rows of these slots.
  std::size_t entries(std::size_t begin, std::size_t end) const;

 private:
  using Float4 = float __attribute__((vector_size(16)));
  struct Columns {  // of a 3x3 block, padded
    Float4 x{}, y{}, z{};
  };
  struct Row {
    std::uint32_t slot = 0, firstBlock = 0, firstWeight = 0;
    float own = 0;  // of the weights
  };
  std::size_t rowAt(std::size_t slot) const { return slot < rowAt_.size() ? rowAt_[slot] : slot_.size(); }

  std::vector<std::uint32_t> slot_;   // that have a row; rows and columns count in these
  std::vector<std::uint32_t> rowAt_;  // of each slot, or the first after it
  std::vector<Row> rows_;             // and one past the last
  std::vector<std::uint32_t> ownBlock_, blockColumn_, weightColumn_;
  std::vector<Columns> block_;
  std::vector<std::uint32_t> sourceStart_, source_;  // pairs that make a block
  std::vector<float> weight_;
  std::vector<Float4> p_;
};

}  // namespace karinui
