#include "cloth/galerkin_part.h"

#include <algorithm>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

struct Direction {  // arrays of its three axes
  const float *x, *y, *z;
};
Direction wayAt(const std::array<std::vector<float>, 3>& way, std::size_t slot) {
  return {way[0].data() + slot, way[1].data() + slot, way[2].data() + slot};
}

// The six entries of across I + along along^T.
KARINUI_WIDE void tension(std::size_t count, std::size_t width, const float* __restrict across, const Direction along,
                          float* __restrict out) {
  KARINUI_APART
  for (std::size_t i = 0; i < count; ++i) {
    const float x = along.x[i], y = along.y[i], z = along.z[i];
    out[i] = across[i] + x * x;
    out[width + i] = x * y;
    out[2 * width + i] = x * z;
    out[3 * width + i] = across[i] + y * y;
    out[4 * width + i] = y * z;
    out[5 * width + i] = across[i] + z * z;
  }
}

// Adds corner way way^T.
KARINUI_WIDE void addShear(std::size_t count, std::size_t width, const float* __restrict corner, const Direction way,
                           float* __restrict out) {
  KARINUI_APART
  for (std::size_t i = 0; i < count; ++i) {
    const float c = corner[i], x = way.x[i], y = way.y[i], z = way.z[i];
    out[i] += c * x * x;
    out[width + i] += c * x * y;
    out[2 * width + i] += c * x * z;
    out[3 * width + i] += c * y * y;
    out[4 * width + i] += c * y * z;
    out[5 * width + i] += c * z * z;
  }
}

// The nine entries of corner a b^T + coupling I.
KARINUI_WIDE void rightAngle(std::size_t count, std::size_t width, const float* __restrict corner,
                             const float* __restrict coupling, const Direction a, const Direction b,
                             float* __restrict out) {
  KARINUI_APART
  for (std::size_t i = 0; i < count; ++i) {
    const float x = corner[i] * a.x[i], y = corner[i] * a.y[i], z = corner[i] * a.z[i], k = coupling[i];
    out[i] = x * b.x[i] + k;
    out[width + i] = x * b.y[i];
    out[2 * width + i] = x * b.z[i];
    out[3 * width + i] = y * b.x[i];
    out[4 * width + i] = y * b.y[i] + k;
    out[5 * width + i] = y * b.z[i];
    out[6 * width + i] = z * b.x[i];
    out[7 * width + i] = z * b.y[i];
    out[8 * width + i] = z * b.z[i] + k;
  }
}

KARINUI_WIDE void addScaled(std::size_t count, float k, const float* __restrict a, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += k * a[i];
}

KARINUI_WIDE void addScaled(std::size_t count, float k, const float* __restrict a, float l, const float* __restrict b,
                            float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += k * a[i] + l * b[i];
}

constexpr std::size_t kDiagonal[] = {0, 3, 5};  // of the six entries of a symmetric block

Block3 symmetric(const float* six, std::size_t stride) {
  const auto at = [&](std::size_t k) { return six[k * stride]; };
  return {at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5)};
}
Block3 full(const float* nine, std::size_t stride) {
  Block3 block;
  for (std::size_t k = 0; k < 9; ++k) block[k] = nine[k * stride];
  return block;
}
Block3 transposed(const Block3& of) { return {of[0], of[3], of[6], of[1], of[4], of[7], of[2], of[5], of[8]}; }
Block3 scalar(float k) { return {k, 0, 0, 0, k, 0, 0, 0, k}; }

}  // namespace

GalerkinPart::LineSplines::LineSplines(const CoarseLines& lines, std::uint32_t line) : cell(lines.cell[line]) {
  const auto valueAt = [&](std::uint32_t at) {
    Reach reach{};
    if (at >= lines.cell.size()) return reach;  // past either end
    for (std::size_t k = 0; k < 3; ++k) reach[lines.cell[at] + 1 + k - cell] = lines.weight[k][at];
    return reach;
  };
  value = valueAt(line);
  const Reach before = valueAt(line - 1), after = valueAt(line + 1);
  for (std::size_t k = 0; k < kReach; ++k) {
    step[k] = after[k] - value[k];
    stepBack[k] = value[k] - before[k];
    second[k] = before[k] + after[k] - 2 * value[k];
    if (before[k] != 0 || value[k] != 0 || after[k] != 0) {
      if (end == 0) begin = k;
      end = k + 1;
    }
  }
}

GalerkinPart::Scratch& GalerkinPart::scratch() {
  thread_local Scratch own;
  return own;
}

GalerkinPart::GalerkinPart(const GalerkinSource& of, const GalerkinSink& sink)
    : step_(of.step), interpolation_(of.interpolation), numberOf_(of.numberOf), sink_(sink), scratch_(scratch()) {}

// Only the lower triangle is stored.
void addTo(EnvelopeCholesky& matrix, std::uint32_t row, std::uint32_t column, float weight, const Block3& block) {
  double* to[3] = {&matrix.at(3 * row, 3 * column), &matrix.at(3 * row + 1, 3 * column),
                   &matrix.at(3 * row + 2, 3 * column)};
  for (std::uint32_t a = 0; a < 3; ++a)
    for (std::uint32_t b = 0; b < (row > column ? 3 : a + 1); ++b)
      to[a][b] += double{weight} * double{block[3 * a + b]};
}

// Splines far from each other whose entry is not stored: half of it and of its transpose falls on each of the two, so
// that a move of both as one strains as before.
void GalerkinPart::lump(std::uint32_t on, const Block3& block, float weight) {
  sink_.add(on, on, 0.5f * weight, block);
  sink_.add(on, on, 0.5f * weight, transposed(block));
}

void GalerkinPart::addEntry(std::uint32_t row, std::uint32_t column, const Block3& block, float weight) {
  if (!sink_.matrix.stores(3 * std::max(row, column), 3 * std::min(row, column)))
    lump(row, block, weight);  // its transpose comes as the other entry
  else if (row >= column)
    sink_.add(row, column, weight, block);
}

void GalerkinPart::addPair(std::uint32_t a, std::uint32_t b, const Block3& block, float weight) {
  if (a != b && sink_.matrix.stores(3 * std::max(a, b), 3 * std::min(a, b))) {  // one of the two
    if (a > b)
      sink_.add(a, b, weight, block);
    else
      sink_.add(b, a, weight, transposed(block));
    return;
  }
  addEntry(a, b, block, weight);
  addEntry(b, a, transposed(block), weight);
}

void GalerkinPart::addForm(std::span<const CoarseWeight> a, std::span<const CoarseWeight> b, const Block3& block) {
  for (const CoarseWeight& of : a)
    for (const CoarseWeight& with : b) addPair(of.node, with.node, block, of.weight * with.weight);
}

void GalerkinPart::findTerms(const GridBlock& block, std::uint32_t row) {
  const GridStiffness& k = step_.stiffness;
  const std::size_t s = block.first + std::size_t{row} * block.stride, n = block.columns, up = block.stride;
  for (std::size_t e = 0; e < 6; ++e) std::copy_n(step_.diagonal[e].data() + s, n, term(kNode + e));
  std::copy_n(step_.bending.weft.data() + s, n, term(kBendWeft));
  std::copy_n(step_.bending.warp.data() + s, n, term(kBendWarp));
  std::copy_n(step_.bending.twist.data() + s, n, term(kTwist));
  // Each right angle strains with both of its threads.
  tension(n, width_, k.weftAcross.data() + s, wayAt(k.weftAlong, s), term(kWeft));
  tension(n, width_, k.warpAcross.data() + s, wayAt(k.warpAlong, s), term(kWarp));
  for (const std::size_t node : {s, s + 1})
    for (const std::size_t warp : {node, node - up})
      addShear(n, width_, k.corner.data() + node, wayAt(k.warpWay, warp), term(kWeft));
  for (const std::size_t node : {s, s + up})
    for (const std::size_t weft : {node, node - 1})
      addShear(n, width_, k.corner.data() + node, wayAt(k.weftWay, weft), term(kWarp));
  constexpr Term kAngles[] = {kForthForth, kForthBack, kBackForth, kBackBack};
  for (std::size_t angle = 0; angle < 4; ++angle)
    rightAngle(n, width_, k.corner.data() + s, k.coupling[angle].data() + s, wayAt(k.warpWay, angle % 2 ? s - up : s),
               wayAt(k.weftWay, angle / 2 ? s - 1 : s), term(kAngles[angle]));
}

// The terms at nodes of a row of which a neighbour or the node itself moves by other weights than its place's: added
// one by one, and taken out of the row.
void GalerkinPart::addApart(const GridBlock& block, std::uint32_t row) {
  const std::size_t first = block.first + std::size_t{row} * block.stride, up = block.stride;
  std::vector<CoarseWeight> weft[2], warp[2], bend;
  const auto combine = [&](std::vector<CoarseWeight>& to, std::initializer_list<std::pair<std::size_t, float>> slots) {
    to.clear();
    for (const auto& [slot, factor] : slots)
      for (const CoarseWeight& entry : interpolation_.of(slot)) to.push_back({entry.node, factor * entry.weight});
  };
  for (std::size_t i = 0; i < block.columns; ++i) {
    const std::size_t s = first + i;
    const auto apart = [&](std::size_t slot) { return interpolation_.apart[slot] != 0; };
    if (!apart(s) && !apart(s - 1) && !apart(s + 1) && !apart(s - up) && !apart(s + up) && !apart(s + up + 1)) continue;
    combine(weft[0], {{s, -1.0f}, {s + 1, 1.0f}});
    combine(weft[1], {{s - 1, -1.0f}, {s, 1.0f}});
    combine(warp[0], {{s, -1.0f}, {s + up, 1.0f}});
    combine(warp[1], {{s - up, -1.0f}, {s, 1.0f}});
    const auto half = [](Block3 of) {  // of a form on its own both orders are added
      for (float& value : of) value *= 0.5f;
      return of;
    };
    const std::span<const CoarseWeight> own = interpolation_.of(s);
    addForm(own, own, half(symmetric(term(kNode) + i, width_)));
    addForm(weft[0], weft[0], half(symmetric(term(kWeft) + i, width_)));
    addForm(warp[0], warp[0], half(symmetric(term(kWarp) + i, width_)));
    addForm(weft[0], warp[0], full(term(kForthForth) + i, width_));
    addForm(weft[0], warp[1], full(term(kForthBack) + i, width_));
    addForm(weft[1], warp[0], full(term(kBackForth) + i, width_));
    addForm(weft[1], warp[1], full(term(kBackBack) + i, width_));
    combine(bend, {{s - 1, 1.0f}, {s, -2.0f}, {s + 1, 1.0f}});
    addForm(bend, bend, scalar(0.5f * term(kBendWeft)[i]));
    combine(bend, {{s - up, 1.0f}, {s, -2.0f}, {s + up, 1.0f}});
    addForm(bend, bend, scalar(0.5f * term(kBendWarp)[i]));
    combine(bend, {{s, 1.0f}, {s + 1, -1.0f}, {s + up, -1.0f}, {s + up + 1, 1.0f}});
    addForm(bend, bend, scalar(0.5f * term(kTwist)[i]));
    for (std::size_t k = 0; k < kTerms; ++k) term(k)[i] = 0;
  }
}

float* GalerkinPart::beginSums(std::size_t b, std::size_t c) {
  float* to = sums(b, c);
  if (!used_[kReach * b + c]) std::fill_n(to, kSums * width_, 0.0f);
  used_[kReach * b + c] = 1;
  return to;
}

void GalerkinPart::sumRow(std::size_t n, const LineSplines& row) {
  for (std::size_t b = row.begin; b < row.end; ++b)
    for (std::size_t c = row.begin; c < row.end; ++c) {
      float* to = beginSums(b, c);
      const float values = row.value[b] * row.value[c], steps = row.step[b] * row.step[c],
                  seconds = row.second[b] * row.second[c], step = row.value[b] * row.step[c],
                  stepBack = row.value[b] * row.stepBack[c];
      for (std::size_t e = 0; e < 9; ++e) {
        addScaled(n, step, term(kForthForth + e), stepBack, term(kForthBack + e), to + (kForth + e) * width_);
        addScaled(n, step, term(kBackForth + e), stepBack, term(kBackBack + e), to + (kBack + e) * width_);
      }
      if (b > c) continue;  // those on their own are symmetric
      for (std::size_t e = 0; e < 6; ++e) {
        addScaled(n, values, term(kNode + e), steps, term(kWarp + e), to + (kValues + e) * width_);
        addScaled(n, values, term(kWeft + e), to + (kSteps + e) * width_);
      }
      for (const std::size_t e : kDiagonal) {
        addScaled(n, seconds, term(kBendWarp), to + (kValues + e) * width_);
        addScaled(n, steps, term(kTwist), to + (kSteps + e) * width_);
      }
      addScaled(n, values, term(kBendWeft), to + kSeconds * width_);
    }
}

// Sums what the rows of a coarse cell have left with the splines of their columns, coarse cell by coarse cell.
void GalerkinPart::addSums(const CoarseGrid& grid, std::uint32_t cell, std::span<const LineSplines> columns) {
  for (std::size_t b = 0; b < kReach; ++b)
    for (std::size_t c = 0; c < kReach; ++c) {
      if (!used_[kReach * b + c]) continue;
      const float* from = sums(b, c);
      const bool symmetric = b <= c;
      for (std::size_t i = 0; i < columns.size();) {
        const std::uint32_t at = columns[i].cell;
        float own[kReach][kReach][6] = {}, crossed[kReach][kReach][9] = {};
        for (; i < columns.size() && columns[i].cell == at; ++i) {
          const LineSplines& column = columns[i];
          for (std::size_t u = column.begin; u < column.end; ++u)
            for (std::size_t v = column.begin; v < column.end; ++v) {
              const float step = column.step[u] * column.value[v], stepBack = column.stepBack[u] * column.value[v];
              for (std::size_t e = 0; e < 9; ++e)
                crossed[u][v][e] += step * from[(kForth + e) * width_ + i] + stepBack * from[(kBack + e) * width_ + i];
              if (!symmetric) continue;
              const float values = column.value[u] * column.value[v], steps = column.step[u] * column.step[v],
                          seconds = column.second[u] * column.second[v] * from[kSeconds * width_ + i];
              for (std::size_t e = 0; e < 6; ++e)
                own[u][v][e] += values * from[(kValues + e) * width_ + i] + steps * from[(kSteps + e) * width_ + i];
              for (const std::size_t e : kDiagonal) own[u][v][e] += seconds;
            }
        }
        const auto numberAt = [&](std::size_t row, std::size_t column) {
          return numberOf_[grid.first + (cell + row - 1) * grid.columns() + at + column - 1];
        };
        for (std::size_t u = 0; u < kReach; ++u)
          for (std::size_t v = 0; v < kReach; ++v) {
            Block3 block = karinui::symmetric(own[u][v], 1);
            for (float& value : block) value *= b == c ? 0.5f : 1.0f;  // of a row on its own both orders are added
            for (std::size_t e = 0; e < 9; ++e) block[e] += crossed[u][v][e];
            if (std::all_of(block.begin(), block.end(), [](float value) { return value == 0; })) continue;
            const std::uint32_t one = numberAt(b, u), other = numberAt(c, v);
            if (one != kNoNode && other != kNoNode) addPair(one, other, block, 1);
          }
      }
    }
}

void GalerkinPart::addCell(const CoarseGrid& grid, std::uint32_t firstRow, std::uint32_t rows) {
  const GridBlock& block = *grid.block;
  width_ = block.stride;
  scratch_.terms.resize(std::max(scratch_.terms.size(), kTerms * width_));
  scratch_.sums.resize(std::max(scratch_.sums.size(), kReach * kReach * kSums * width_));
  std::vector<LineSplines> columns;
  for (std::uint32_t i = 0; i < block.columns; ++i) columns.emplace_back(grid.column, i);
  const auto begin = interpolation_.apart.begin() + block.first + firstRow * block.stride - block.stride - 1;
  const bool apart = std::any_of(begin, begin + (rows + 2) * block.stride + 2, [](std::uint8_t is) { return is != 0; });
  used_ = {};
  for (std::uint32_t row = firstRow; row < firstRow + rows; ++row) {
    findTerms(block, row);
    if (apart) addApart(block, row);
    sumRow(block.columns, LineSplines(grid.row, row));
  }
  addSums(grid, grid.row.cell[firstRow], columns);
}

// Row by row (A P) and then P^T (A P).
void GalerkinPart::addRest(const SlotRange& range) {
  std::vector<Block3>& product = scratch_.product;
  std::vector<std::uint8_t>& has = scratch_.has;
  std::vector<std::uint32_t>& numbers = scratch_.numbers;
  product.resize(std::max(product.size(), sink_.numbers)), has.resize(std::max(has.size(), sink_.numbers));
  const auto clear = [&] {
    for (const std::uint32_t number : numbers) product[number] = {}, has[number] = 0;
    numbers.clear();
  };
  clear();  // what was left where memory ran out in the middle of a row
  const auto multiply = [&](std::size_t column, const Block3& block) {
    for (const CoarseWeight& entry : interpolation_.of(column)) {
      if (!has[entry.node]) numbers.push_back(entry.node);
      has[entry.node] = 1;
      for (std::size_t e = 0; e < 9; ++e) product[entry.node][e] += entry.weight * block[e];
    }
  };
  for (std::size_t slot = range.begin; slot < range.end; ++slot) {
    const std::span<const CoarseWeight> own = interpolation_.of(slot);
    if (own.empty()) continue;
    step_.sparse.forRow(slot, multiply);
    if (range.unstructured()) {
      const DiagonalBlocks& d = step_.diagonal;
      multiply(slot, {d[0][slot], d[1][slot], d[2][slot], d[1][slot], d[3][slot], d[4][slot], d[2][slot], d[4][slot],
                      d[5][slot]});
    }
    for (const std::uint32_t number : numbers)
      for (const CoarseWeight& entry : own) addEntry(entry.node, number, product[number], entry.weight);
    clear();
  }
}

void GalerkinPart::addCouplings(std::size_t begin, std::size_t end) {
  std::vector<CoarseWeight>& sum = scratch_.sum;
  step_.couplings.forEach(begin, end, [&](std::span<const Couplings::Term> terms, const Block3& block) {
    sum.clear();
    for (const Couplings::Term& term : terms)
      for (const CoarseWeight& entry : interpolation_.of(term.slot)) {
        const float weight = term.weight * entry.weight;
        const auto of = std::find_if(sum.begin(), sum.end(), [&](const auto& its) { return its.node == entry.node; });
        if (of == sum.end())
          sum.push_back({entry.node, weight});
        else
          of->weight += weight;
      }
    for (const CoarseWeight& a : sum)
      for (const CoarseWeight& b : sum) addEntry(a.node, b.node, block, a.weight * b.weight);
  });
}

}  // namespace karinui
