#include "cloth/sparse_rows.h"

#include <algorithm>

#include "cloth/by_row.h"

namespace karinui {
namespace {

constexpr std::size_t kBlock = 256;

struct Wanted {
  std::uint32_t row = 0, column = 0, pair = 0;
};
using Plain = NodeWeight;  // its nodes numbered as rows

}  // namespace

SparseRows::SparseRows(std::span<const std::uint32_t> slotOf, std::span<const NodePair> pairs,
                       std::span<const NodeWeight> weights) {
  std::vector<std::uint8_t> spokenOf;
  const auto speak = [&](NodeIndex node) {
    if (spokenOf.size() <= slotOf[node]) spokenOf.resize(slotOf[node] + 1, 0);
    spokenOf[slotOf[node]] = 1;
  };
  for (const NodePair& pair : pairs) speak(pair.row);
  for (const NodeWeight& w : weights) speak(w.row);
  for (std::uint32_t s = 0; s < spokenOf.size(); ++s) {
    rowAt_.push_back(static_cast<std::uint32_t>(slot_.size()));
    if (spokenOf[s]) slot_.push_back(s);
  }
  const auto place = [&](NodeIndex node) { return rowAt_[slotOf[node]]; };
  std::vector<Wanted> blocks;
  for (std::uint32_t s = 0; s < pairs.size(); ++s) blocks.push_back({place(pairs[s].row), place(pairs[s].column), s});
  std::vector<Plain> plain;
  for (const NodeWeight& w : weights) plain.push_back({place(w.row), place(w.column), w.weight});
  sortByRow(
      blocks, slot_.size(), [](const Wanted& b) { return b.row; }, [](const Wanted& b) { return b.column; });
  sortByRow(
      plain, slot_.size(), [](const Plain& w) { return w.row; }, [](const Plain& w) { return w.column; });

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
    while (w < plain.size() && plain[w].row == row) {
      const std::uint32_t column = plain[w].column;
      double sum = 0;
      for (; w < plain.size() && plain[w].row == row && plain[w].column == column; ++w) sum += plain[w].weight;
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

void SparseRows::gather(std::span<const Block3> blocks, OwnBlocks& own, Workers& workers) {
  workers.forBlocks(slot_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
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

void SparseRows::takeUp(const Lanes3& p, std::size_t begin, std::size_t end) {
  for (std::size_t k = rowAt(begin), last = rowAt(end); k < last; ++k)
    p_[k] = Float4{p[0][slot_[k]], p[1][slot_[k]], p[2][slot_[k]], 0};
}

void SparseRows::multiply(std::size_t begin, std::size_t end, Lanes3& q) const {
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
