#pragma once
// A part of the Galerkin matrix A_c = P^T A P of a coarse space (galerkin_matrix.h): what some of the terms add to it
// that the step's matrix A is made of.
//
// In a grid block P is a spline along the row times one along the column. So the terms on a coarse cell's fine rows are
// first summed with the splines of the rows, in wide loops over the columns, and the few sums that are left with those
// of the columns: the work of some ten products with A. What has no such order (the ring, seams, held nodes) goes entry
// by entry.
#include <array>
#include <span>
#include <vector>

#include "cloth/coarse_grid.h"
#include "cloth/couplings.h"
#include "cloth/envelope_cholesky.h"
#include "cloth/sparse_rows.h"

namespace karinui {

// The step's matrix. The arrays are over slots.
struct StepMatrix {
  const GridStiffness& stiffness;
  const GridBending& bending;
  const DiagonalBlocks& diagonal;  // without that of stiffness and bending
  const SparseRows& sparse;
  const Couplings& couplings;
};

// P: what each slot moves with, as numbers of rows of A_c.
struct Interpolation {
  std::vector<std::uint32_t> start;   // per slot, and one past the last
  std::vector<CoarseWeight> entries;  // their nodes are numbers in A_c
  std::vector<std::uint8_t> apart;    // per slot of a grid block: whether it does not move by the splines of its place
  std::span<const CoarseWeight> of(std::size_t slot) const {
    return std::span(entries).subspan(start[slot], start[slot + 1] - start[slot]);
  }
};

// What A_c is made of. `numberOf`: of each coarse node its number in A_c, kNoNode where it is left out. All that is
// referred to must outlive whoever has this.
struct GalerkinSource {
  const GridLayout& layout;
  const StepMatrix& step;
  const Interpolation& interpolation;
  std::span<const std::uint32_t> numberOf;
  bool coupled = true;  // whether A_c stores what couplings couple
};

// `weight` times `block`, at three rows and columns of A_c; the column is not past the row.
struct GalerkinEntry {
  std::uint32_t row = 0, column = 0;
  float weight = 0;
  Block3 block;
};
void addTo(EnvelopeCholesky& matrix, std::uint32_t row, std::uint32_t column, float weight, const Block3& block);

// Where entries go, in their order: to the matrix at once, or into one of several lists, each of a range of its rows.
struct GalerkinSink {
  EnvelopeCholesky& matrix;
  std::span<std::vector<GalerkinEntry>> lists;  // none: to the matrix
  std::size_t numbers = 0;                      // in the matrix
  void add(std::uint32_t row, std::uint32_t column, float weight, const Block3& block) const {
    if (lists.empty())
      addTo(matrix, row, column, weight, block);
    else
      lists[row * lists.size() / numbers].push_back({row, column, weight, block});
  }
};

class GalerkinPart {
 public:
  GalerkinPart(const GalerkinSource& of, const GalerkinSink& sink);

  // Fine rows that lie in one coarse cell of a grid that has a block: all but theirs in `step.sparse`.
  void addCell(const CoarseGrid& grid, std::uint32_t firstRow, std::uint32_t rows);
  void addRest(const SlotRange& range);  // those rows, and what lies in no block
  void addCouplings(std::size_t begin, std::size_t end);

 private:
  // Coarse lines that the terms on a fine line depend on: those of its cell, of the one before and of the one after.
  static constexpr std::size_t kReach = 5;
  using Reach = std::array<float, kReach>;
  struct LineSplines {  // at a fine line, from the coarse line before its cell's first on
    std::uint32_t cell = 0;
    Reach value{}, step{}, stepBack{}, second{};  // `step`: from this line to the next; `stepBack`: from the last one
    std::size_t begin = 0, end = 0;               // which of these are not nothing
    LineSplines(const CoarseLines& lines, std::uint32_t line);
  };
  // Terms at a node of a block: of the node itself; of the threads from it along weft and warp; of the weft thread
  // forth and back from it with the warp thread forth and back.
  enum Term : std::size_t {
    kNode = 0,
    kWeft = 6,
    kWarp = 12,
    kForthForth = 18,
    kForthBack = 27,
    kBackForth = 36,
    kBackBack = 45,
    kBendWeft = 54,
    kBendWarp,
    kTwist,
    kTerms
  };
  // Their sums over rows: on values along the row, on steps and on second differences, and on steps forth and back with
  // values.
  enum Sum : std::size_t { kValues = 0, kSteps = 6, kSeconds = 12, kForth = 13, kBack = 22, kSums = 31 };

  void findTerms(const GridBlock& block, std::uint32_t row);
  void addApart(const GridBlock& block, std::uint32_t row);
  void sumRow(std::size_t count, const LineSplines& row);
  void addSums(const CoarseGrid& grid, std::uint32_t cell, std::span<const LineSplines> columns);
  float* sums(std::size_t b, std::size_t c) { return scratch_.sums.data() + (kReach * b + c) * kSums * width_; }
  float* beginSums(std::size_t b, std::size_t c);
  float* term(std::size_t k) { return scratch_.terms.data() + k * width_; }
  void addForm(std::span<const CoarseWeight> a, std::span<const CoarseWeight> b, const Block3& block);
  void addPair(std::uint32_t a, std::uint32_t b, const Block3& block, float weight);  // an entry and its transpose
  void addEntry(std::uint32_t row, std::uint32_t column, const Block3& block, float weight);
  void add(std::uint32_t row, std::uint32_t column, const Block3& block, float weight);
  void lump(std::uint32_t on, const Block3& block, float weight);

  struct Scratch {  // of a thread
    std::vector<float> terms, sums;
    std::vector<Block3> product;  // of a row with P, per number; none between two rows
    std::vector<std::uint8_t> has;
    std::vector<std::uint32_t> numbers;  // that have some
    std::vector<CoarseWeight> sum;       // a coupling's terms
  };
  static Scratch& scratch();

  const StepMatrix& step_;
  const Interpolation& interpolation_;
  std::span<const std::uint32_t> numberOf_;
  GalerkinSink sink_;
  Scratch& scratch_;
  std::size_t width_ = 0;                             // of a row of the block
  std::array<std::uint8_t, kReach * kReach> used_{};  // pairs of coarse rows whose sums are begun
};

}  // namespace karinui
