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
