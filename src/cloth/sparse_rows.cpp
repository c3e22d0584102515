#include "cloth/sparse_rows.h"

#include <algorithm>

#include "cloth/sort_by_row.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

struct BlockEntry {
  std::uint32_t row = 0, column = 0, pair = 0;
};
using WeightEntry = NodeWeight;  // its nodes numbered as rows

}  // namespace

SparseRows::SparseRows(std::span<const std::uint32_t> slotOf, std::span<const NodePair> pairs,
                       std::span<const NodeWeight> weights) {
  std::vector<std::uint8_t> hasRow;
  const auto mark = [&](NodeIndex node) {
    if (hasRow.size() <= slotOf[node]) hasRow.resize(slotOf[node] + 1, 0);
    hasRow[slotOf[node]] = 1;
  };
  for (const NodePair& pair : pairs) mark(pair.row);
  for (const NodeWeight& w : weights) mark(w.row);
  for (std::uint32_t s = 0; s < hasRow.size(); ++s) {
    rowAt_.push_back(static_cast<std::uint32_t>(slot_.size()));
    if (hasRow[s]) slot_.push_back(s);
  }
  const auto place = [&](NodeIndex node) { return rowAt_[slotOf[node]]; };
  std::vector<BlockEntry> blocks;
  for (std::uint32_t s = 0; s < pairs.size(); ++s) blocks.push_back({place(pairs[s].row), place(pairs[s].column), s});
  std::vector<WeightEntry> scalar;
  for (const NodeWeight& w : weights) scalar.push_back({place(w.row), place(w.column), w.weight});
  sortByRow(
      blocks, slot_.size(), [](const BlockEntry& b) { return b.row; }, [](const BlockEntry& b) { return b.column; });
  sortByRow(
      scalar, slot_.size(), [](const WeightEntry& w) { return w.row; }, [](const WeightEntry& w) { return w.column; });

  std::size_t b = 0, w = 0;
  ownBlock_.assign(slot_.size(), kNoNode);
  for (std::uint32_t row = 0; row < slot_.size(); ++row) {
    rows_.push_back(
        {slot_[row], static_cast<std::uint32_t>(block_.size()), static_cast<std::uint32_t>(weight_.size())});
    while (b < blocks.size() && blocks[b].row == row) {
      const std::uint32_t column = blocks[b].column;
      if (column == row) ownBlock_[row] = static_cast<std::uint32_t>(block_.size());
      sourceStart_.push_back(static_cast<std::uint32_t>(source_.size()));
      for (; b < blocks.size() && blocks[b].row == row && blocks[b].column == column; ++b)
        source_.push_back(blocks[b].pair);
      blockColumn_.push_back(column);
      block_.emplace_back();
    }
    while (w < scalar.size() && scalar[w].row == row) {
      const std::uint32_t column = scalar[w].column;
      double sum = 0;
      for (; w < scalar.size() && scalar[w].row == row && scalar[w].column == column; ++w) sum += scalar[w].weight;
      if (column == row) {
        rows_.back().own = static_cast<float>(sum);
      } else {
        weightColumn_.push_back(column);
        weight_.push_back(static_cast<float>(sum));
      }
    }
  }
  rows_.push_back({0, static_cast<std::uint32_t>(block_.size()), static_cast<std::uint32_t>(weight_.size())});
  sourceStart_.push_back(static_cast<std::uint32_t>(source_.size()));
  p_.resize(slot_.size());
}

void SparseRows::assemble(std::span<const Block3> blocks, DiagonalBlocks& own, Workers& workers) {
  workers.forBlocks(slot_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      for (std::uint32_t k = rows_[row].firstBlock; k < rows_[row + 1].firstBlock; ++k) {
        Columns sum;
        for (std::uint32_t s = sourceStart_[k]; s < sourceStart_[k + 1]; ++s) {
          const Block3& from = blocks[source_[s]];
          sum.x += Float4{from[0], from[3], from[6], 0};
          sum.y += Float4{from[1], from[4], from[7], 0};
          sum.z += Float4{from[2], from[5], from[8], 0};
        }
        block_[k] = sum;
      }
      const std::uint32_t slot = slot_[row];
      for (const std::size_t axis : {0u, 3u, 5u}) own[axis][slot] += rows_[row].own;
      if (ownBlock_[row] == kNoNode) continue;
      Columns& mine = block_[ownBlock_[row]];
      own[0][slot] += mine.x[0];
      own[1][slot] += mine.y[0];
      own[2][slot] += mine.z[0];
      own[3][slot] += mine.y[1];
      own[4][slot] += mine.z[1];
      own[5][slot] += mine.z[2];
      mine = {};
    }
  });
}

std::size_t SparseRows::entries(std::size_t begin, std::size_t end) const {
  const Row &first = rows_[rowAt(begin)], &last = rows_[rowAt(end)];
  return last.firstBlock - first.firstBlock + (last.firstWeight - first.firstWeight);
}

void SparseRows::load(const SlotVectors& p, std::size_t begin, std::size_t end) {
  for (std::size_t k = rowAt(begin), last = rowAt(end); k < last; ++k)
    p_[k] = Float4{p[0][slot_[k]], p[1][slot_[k]], p[2][slot_[k]], 0};
}

void SparseRows::multiply(std::size_t begin, std::size_t end, SlotVectors& q) const {
  for (std::size_t row = rowAt(begin), rows = rowAt(end); row < rows; ++row) {
    Float4 sum{};
    for (std::uint32_t k = rows_[row].firstBlock; k < rows_[row + 1].firstBlock; ++k) {
      const Float4 from = p_[blockColumn_[k]];
      sum += block_[k].x * from[0] + block_[k].y * from[1] + block_[k].z * from[2];
    }
    // Four sums side by side, so that none waits for the last.
    Float4 part[4] = {};
    std::uint32_t w = rows_[row].firstWeight;
    const std::uint32_t last = rows_[row + 1].firstWeight;
    for (; w + 4 <= last; w += 4)
      for (std::uint32_t n = 0; n < 4; ++n) part[n] += weight_[w + n] * p_[weightColumn_[w + n]];
    for (; w < last; ++w) part[0] += weight_[w] * p_[weightColumn_[w]];
    sum += (part[0] + part[1]) + (part[2] + part[3]);
    for (std::size_t axis = 0; axis < 3; ++axis) q[axis][slot_[row]] += sum[axis];
  }
}

}  // namespace karinui
