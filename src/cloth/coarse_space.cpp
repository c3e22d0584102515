#include "cloth/coarse_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "karinui/base/sort_once.h"
#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kCoarsening = 6;  // fine lines in a coarse cell, about; more in very fine cloth,
constexpr double kMostCells = 36;  // so that a square has no more coarse cells a side: their solve is one thread's
// Sum of squared weights: a coarse node that moves less is left out. Next to it P no longer moves cloth as one, and
// many splines reach over a curved edge by their tails, so only what is next to nothing.
constexpr double kLeastSupport = 0.001;
// Entries of A_c for each slot: with more its solve takes longer than what knowing of contacts saves. Garments of two
// and three layers have 15 to 35.
constexpr std::size_t kMostStored = 100;
// Of the diagonal of A_c, added to it until it is positive: coarse nodes with few nodes left may depend on each other.
constexpr double kShifts[] = {0, 1e-7, 1e-5, 1e-3};

struct Three {  // weights
  float a, b, c;
};

// Restricts a fine row onto three coarse rows.
KARINUI_WIDE void restrictRow(std::size_t count, const Three weight, const float* __restrict r,
                              const float* __restrict free, float* __restrict a, float* __restrict b,
                              float* __restrict c) {
  for (std::size_t k = 0; k < count; ++k) {
    const float own = free[k] * r[k];
    a[k] += weight.a * own;
    b[k] += weight.b * own;
    c[k] += weight.c * own;
  }
}

// A coarse row at the fine columns of a cell, and at some more.
KARINUI_WIDE void interpolateCell(std::size_t begin, std::size_t end, const Three value, const float* __restrict a,
                                  const float* __restrict b, const float* __restrict c, float* __restrict row) {
  for (std::size_t i = begin; i < end; i += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) row[i + l] = a[i + l] * value.a + b[i + l] * value.b + c[i + l] * value.c;
}

// `rows`: the first of three coarse ones, `stride` apart.
KARINUI_WIDE void updateDirectionRow(std::size_t count, float beta, const float* __restrict rows, std::size_t stride,
                                     const Three weight, const float* __restrict free, const float* __restrict z,
                                     float* __restrict p) {
  const float *a = rows, *b = rows + stride, *c = rows + 2 * stride;
  for (std::size_t k = 0; k < count; ++k)
    p[k] = z[k] + beta * p[k] + free[k] * (weight.a * a[k] + weight.b * b[k] + weight.c * c[k]);
}

KARINUI_WIDE void updateDirectionUnstructured(std::size_t begin, std::size_t end, float beta, const float* __restrict z,
                                              float* __restrict p) {
  for (std::size_t s = begin; s < end; ++s) p[s] = z[s] + beta * p[s];
}

}  // namespace

CoarseSpace::CoarseSpace(const Cloth& cloth, const GridLayout& layout)
    : cloth_(cloth), layout_(layout), stencils_(layout.slots) {
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const auto block =
        std::find_if(layout.blocks.begin(), layout.blocks.end(), [&](const GridBlock& q) { return q.piece == p; });
    if (block != layout.blocks.end()) gridOf_.push_back(static_cast<std::uint32_t>(grids_.size()));
    if (cloth.pieces[p].live) addGrid(cloth.pieces[p], block == layout.blocks.end() ? nullptr : &*block);
  }
  for (auto& axis : value_) axis.assign(nodes_, 0);
  for (const SlotRange& range : layout.ranges) restrictions_.push_back(restrictionOf(range));
}

std::pair<std::uint32_t, std::uint32_t> CoarseSpace::coarseRows(const SlotRange& range) const {
  const std::vector<std::uint32_t>& cell = grids_[gridOf_[range.block]].row.cell;
  const std::uint32_t first = cell[range.row];
  return {first, cell[range.row + range.rows - 1] + 3 - first};
}

CoarseSpace::Restriction CoarseSpace::restrictionOf(const SlotRange& range) const {
  Restriction restricted;
  if (!range.unstructured()) {
    const CoarseGrid& grid = grids_[gridOf_[range.block]];
    const auto [first, count] = coarseRows(range);
    restricted.first = grid.first + first * grid.columns();
    restricted.count = count * grid.columns();
  } else {
    std::uint32_t least = nodes_, most = 0;
    for (std::size_t slot = range.begin; slot < range.end; ++slot)
      for (const CoarseWeight& entry : stencils_[slot])
        if (entry.weight > 0) {
          least = std::min(least, entry.node);
          most = std::max(most, entry.node);
        }
    restricted.first = std::min(least, most);
    restricted.count = least > most ? 0 : most - least + 1;
  }
  restricted.value.assign(3 * std::size_t{restricted.count}, 0);
  return restricted;
}

void CoarseSpace::addGrid(const ClothPiece& piece, const GridBlock* block) {
  const Lattice& lattice = *piece.lattice;
  const double each = std::fmax(kCoarsening, std::sqrt(1.0 * lattice.columns * lattice.rows) / kMostCells);
  CoarseGrid grid{block, CoarseLines(lattice.columns, each), CoarseLines(lattice.rows, each), nodes_};
  nodes_ += grid.columns() * grid.rows();
  const double weftStep = block ? block->weftStep : lattice.spacing,
               warpStep = block ? block->warpStep : lattice.spacing;
  Flat origin = lattice.nodes.front();  // of the grid; a piece too narrow for one has a grid of one cell
  for (std::uint32_t j = 0; j < lattice.rows; ++j)
    for (std::uint32_t i = 0; i < lattice.columns; ++i)
      if (const std::uint32_t k = lattice.grid[std::size_t{j} * lattice.columns + i]; k != kNoNode) {
        origin = lattice.nodes[k] - lattice.weft * (i * weftStep) - lattice.warp * (j * warpStep);
      }
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const std::uint32_t slot = layout_.slotOf[piece.firstNode + k];
    const Flat at = lattice.nodes[k] - origin;
    stencils_[slot] = stencilAt(grid, dot(at, lattice.weft) / weftStep, dot(at, lattice.warp) / warpStep);
  }
  grids_.push_back(std::move(grid));
}

void CoarseSpace::setTies(std::span<const std::uint32_t> independents, std::span<const DependentSlot> dependents) {
  free_.assign(layout_.slots, 0);
  for (const std::uint32_t independent : independents) free_[independent] = 1;
  dependents_.assign(dependents.begin(), dependents.end());
  numbered_ = ready_ = false;
}

void CoarseSpace::findSupported() {
  std::vector<double> support(nodes_, 0);
  for (std::size_t slot = 0; slot < free_.size(); ++slot)
    if (free_[slot] > 0)
      for (const CoarseWeight& entry : stencils_[slot]) support[entry.node] += double{entry.weight} * entry.weight;
  numberOf_.assign(nodes_, kNoNode);
  supported_.clear();
  for (std::uint32_t node = 0; node < nodes_; ++node)
    if (support[node] > kLeastSupport) {
      numberOf_[node] = static_cast<std::uint32_t>(supported_.size());
      supported_.push_back(node);
    }
  // Two coarse nodes are coupled where a face of the cloth depends on both.
  std::vector<std::vector<std::uint32_t>> independents(layout_.slots);
  for (const DependentSlot& dependent : dependents_) independents[dependent.slot].push_back(dependent.independent);
  overFaces_.assign(supported_.size(), {});
  std::vector<std::uint32_t> coupled, last;
  const auto addCoarseNodes = [&](std::uint32_t slot) {
    if (free_[slot] == 0) return;
    for (const CoarseWeight& entry : stencils_[slot])
      if (entry.weight > 0 && numberOf_[entry.node] != kNoNode) coupled.push_back(numberOf_[entry.node]);
  };
  for (const ClothPiece& piece : cloth_.pieces) {
    if (!piece.live) continue;
    for (const Triangle& face : piece.lattice->faces) {
      coupled.clear();
      for (const std::uint32_t k : face) {
        const std::uint32_t slot = layout_.slotOf[piece.firstNode + k];
        addCoarseNodes(slot);
        for (const std::uint32_t independent : independents[slot]) addCoarseNodes(independent);
      }
      sortOnce(coupled);
      if (coupled == last) continue;
      for (const std::uint32_t a : coupled) overFaces_[a].insert(overFaces_[a].end(), coupled.begin(), coupled.end());
      last = coupled;
    }
  }
  for (auto& list : overFaces_) sortOnce(list);
}

// Slots of one coarse cell move with the same coarse nodes, so a cell is asked about by one of its slots.
void CoarseSpace::addContacts(const Couplings& couplings, Neighbours& around) const {
  std::vector<std::uint32_t> slotOfCell(nodes_, kNoNode);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;
  couplings.forEach(0, couplings.size(), [&](std::span<const Couplings::Term> terms, const Block3&) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const std::uint32_t cell = stencils_[terms[i].slot].front().node;
      slotOfCell[cell] = terms[i].slot;
      for (std::size_t j = 0; j < i; ++j)
        if (const std::uint32_t other = stencils_[terms[j].slot].front().node; other != cell)
          cells.emplace_back(std::min(cell, other), std::max(cell, other));
    }
  });
  sortOnce(cells);
  const auto placesOf = [&](std::uint32_t cell) {
    std::vector<std::uint32_t> places;
    for (const CoarseWeight& entry : stencils_[slotOfCell[cell]])
      if (numberOf_[entry.node] != kNoNode) places.push_back(numberOf_[entry.node]);
    return places;
  };
  for (const auto& [cell, other] : cells) {
    const std::vector<std::uint32_t> here = placesOf(cell), there = placesOf(other);
    for (const std::uint32_t a : here) around[a].insert(around[a].end(), there.begin(), there.end());
    for (const std::uint32_t b : there) around[b].insert(around[b].end(), here.begin(), here.end());
  }
  for (auto& list : around) sortOnce(list);
}

std::size_t CoarseSpace::renumber(const Neighbours& around) {
  const std::vector<std::uint32_t> numbers = reverseCuthillMcKee(around);
  nodeOf_.resize(supported_.size());
  std::vector<std::uint32_t> first(3 * supported_.size());
  std::size_t stored = 0;
  for (std::uint32_t place = 0; place < supported_.size(); ++place) {
    const std::uint32_t number = numbers[place];
    nodeOf_[number] = supported_[place];
    numberOf_[supported_[place]] = number;
    std::uint32_t least = number;
    for (const std::uint32_t other : around[place]) least = std::min(least, numbers[other]);
    for (std::uint32_t axis = 0; axis < 3; ++axis) first[3 * number + axis] = 3 * least;
    stored += 9 * std::size_t{number - least} + 6;
  }
  matrix_ = EnvelopeCholesky(std::move(first));
  found_.assign(3 * nodeOf_.size(), 0);
  findRows();
  return stored;
}

void CoarseSpace::number(const Couplings& couplings) {
  if (!numbered_) findSupported();
  for (std::uint32_t place = 0; place < supported_.size(); ++place) numberOf_[supported_[place]] = place;
  coupled_ = couplings.size() > 0;
  Neighbours around = overFaces_;
  if (coupled_) addContacts(couplings, around);
  if (renumber(around) > kMostStored * layout_.slots && std::exchange(coupled_, false)) renumber(overFaces_);
  numbered_ = true;
}

void CoarseSpace::findRows() {
  std::vector<std::vector<DependentSlot>> hanging(layout_.slots);
  for (const DependentSlot& dependent : dependents_) hanging[dependent.slot].push_back(dependent);
  interpolation_.start.assign(1, 0);
  interpolation_.entries.clear();
  const auto addStencil = [&](std::uint32_t slot, float weight) {
    for (const CoarseWeight& entry : stencils_[slot])
      if (const std::uint32_t number = entry.weight > 0 ? numberOf_[entry.node] : kNoNode; number != kNoNode)
        interpolation_.entries.push_back({number, weight * entry.weight});
  };
  for (std::uint32_t slot = 0; slot < layout_.slots; ++slot) {
    if (free_[slot] > 0) addStencil(slot, 1);
    for (const DependentSlot& dependent : hanging[slot]) addStencil(dependent.independent, dependent.weight);
    interpolation_.start.push_back(static_cast<std::uint32_t>(interpolation_.entries.size()));
  }
  interpolation_.apart.assign(layout_.slots, 0);
  for (const std::uint32_t slot : layout_.slotOf)
    if (slot != kNoNode && free_[slot] == 0) interpolation_.apart[slot] = 1;
}

bool CoarseSpace::assemble(const StepMatrix& step, Workers& workers) {
  if (!numbered_ || coupled_ || step.couplings.size() > 0) number(step.couplings);
  matrix_.clear();
  galerkin_.assemble({layout_, step, interpolation_, numberOf_, coupled_}, grids_, nodeOf_.size(), matrix_, workers);
  ready_ =
      std::any_of(std::begin(kShifts), std::end(kShifts), [&](double shift) { return matrix_.factor(workers, shift); });
  return ready_;
}

void CoarseSpace::restrictResidual(const SlotRange& range, const SlotVectors& r) {
  Restriction& restricted = restrictions_[static_cast<std::size_t>(&range - layout_.ranges.data())];
  std::fill(restricted.value.begin(), restricted.value.end(), 0.0f);
  if (restricted.count == 0) return;
  if (range.unstructured()) {
    for (std::size_t slot = range.begin; slot < range.end; ++slot) {
      if (free_[slot] == 0) continue;
      for (const CoarseWeight& entry : stencils_[slot]) {
        if (entry.weight == 0) continue;
        float* to = restricted.value.data() + (entry.node - restricted.first);
        for (std::size_t axis = 0; axis < 3; ++axis) to[axis * restricted.count] += entry.weight * r[axis][slot];
      }
    }
    return;
  }
  const GridBlock& block = layout_.blocks[range.block];
  const CoarseGrid& grid = grids_[gridOf_[range.block]];
  const auto [first, count] = coarseRows(range);
  thread_local std::array<std::vector<float>, 3> rows;  // the coarse rows at the fine columns, one after the other
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows[axis].assign(count * block.columns, 0);
    for (std::size_t j = range.row; j < range.row + range.rows; ++j) {
      const std::size_t s = block.first + j * block.stride;
      float* to = rows[axis].data() + (grid.row.cell[j] - first) * block.columns;
      restrictRow(block.columns, {grid.row.weight[0][j], grid.row.weight[1][j], grid.row.weight[2][j]},
                  r[axis].data() + s, free_.data() + s, to, to + block.columns, to + 2 * block.columns);
    }
  }
  // Cell by cell onto its three splines. The sums of all axes side by side, so that none waits for the last.
  for (std::size_t c = 0; c < count; ++c) {
    float* to = restricted.value.data() + c * grid.columns();
    for (std::size_t cell = 0, i = 0; cell + 2 < grid.columns(); ++cell) {
      float sum[3][3] = {};
      for (; i < block.columns && grid.column.cell[i] == cell; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float own = rows[axis][c * block.columns + i];
          for (std::size_t k = 0; k < 3; ++k) sum[axis][k] += grid.column.weight[k][i] * own;
        }
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t k = 0; k < 3; ++k) to[axis * restricted.count + cell + k] += sum[axis][k];
    }
  }
}

void CoarseSpace::sumRestrictions() {
  for (auto& value : value_) std::fill(value.begin(), value.end(), 0.0f);
  for (const Restriction& restricted : restrictions_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* from = restricted.value.data() + axis * restricted.count;
      float* to = value_[axis].data() + restricted.first;
      for (std::size_t k = 0; k < restricted.count; ++k) to[k] += from[k];
    }
}

double CoarseSpace::coarseSolve() {
  sumRestrictions();
  for (std::size_t c = 0; c < nodeOf_.size(); ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) found_[3 * c + axis] = value_[axis][nodeOf_[c]];
  matrix_.solve(found_);
  double product = 0;
  for (std::size_t c = 0; c < nodeOf_.size(); ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float& value = value_[axis][nodeOf_[c]];
      product += double{value} * double{found_[3 * c + axis]};
      value = found_[3 * c + axis];
    }
  for (std::uint32_t node = 0; node < nodes_; ++node)
    if (numberOf_[node] == kNoNode)
      for (auto& values : value_) values[node] = 0;
  return product;
}

void CoarseSpace::updateDirection(const SlotRange& range, const SlotVectors& z, float beta, SlotVectors& p) const {
  if (range.unstructured()) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      updateDirectionUnstructured(range.begin, range.end, beta, z[axis].data(), p[axis].data());
    for (std::size_t slot = range.begin; slot < range.end; ++slot) {
      if (free_[slot] == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float move = 0;
        for (const CoarseWeight& entry : stencils_[slot]) move += entry.weight * value_[axis][entry.node];
        p[axis][slot] += move;
      }
    }
    return;
  }
  const GridBlock& block = layout_.blocks[range.block];
  const CoarseGrid& grid = grids_[gridOf_[range.block]];
  const auto [first, count] = coarseRows(range);
  thread_local std::vector<float> rows;  // coarse ones at the fine columns, one after the other
  rows.resize(count * block.stride + kLanes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < count; ++c) {
      const float* from = value_[axis].data() + grid.first + (first + c) * grid.columns();
      for (std::size_t cell = 0; cell + 2 < grid.columns(); ++cell)
        interpolateCell(grid.column.at[cell], grid.column.at[cell + 1] + 1,
                        {from[cell], from[cell + 1], from[cell + 2]}, grid.column.weight[0].data(),
                        grid.column.weight[1].data(), grid.column.weight[2].data(), rows.data() + c * block.stride);
    }
    for (std::size_t j = range.row; j < range.row + range.rows; ++j) {
      const std::size_t s = block.first + j * block.stride;
      const float* row = rows.data() + (grid.row.cell[j] - first) * block.stride;
      updateDirectionRow(block.columns, beta, row, block.stride,
                         {grid.row.weight[0][j], grid.row.weight[1][j], grid.row.weight[2][j]}, free_.data() + s,
                         z[axis].data() + s, p[axis].data() + s);
    }
  }
}

}  // namespace karinui
