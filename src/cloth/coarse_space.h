#pragma once
// The coarse level of a two-level additive preconditioner, M^-1 = D^-1 + P A_c^-1 P^T (Smith, Bjorstad, Gropp: Domain
// Decomposition, 1996, chapter 1). Conjugate gradients with the diagonal D alone pass a force on from node to node, one
// iteration each, so that long waves take hundreds. The coarse nodes lie on a grid, one for every eight lattice nodes
// each way (fewer in very fine cloth); P interpolates between them, and the Galerkin matrix A_c = P^T A P is factored.
//
// P is bilinear, or in fine cloth of quadratic B-splines (de Boor: A Practical Guide to Splines, 1978). Bending goes
// with the second derivative of a move. Where a bilinear P has a kink, all of the bending falls on one cell, and the
// finer the cells are, the stiffer A_c takes long waves for. Splines couple more coarse nodes, so that A_c costs three
// times as much: small cloth rests sooner without.
//
// A_c may be older than the step's A: that costs iterations, not accuracy.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "cloth/envelope_cholesky.h"
#include "cloth/grid_product.h"

namespace karinui {

// The slot of a node that is no unknown of its own: it moves by `weight` times the slot of an independent one.
struct DependentSlot {
  std::uint32_t slot = 0, independent = 0;
  float weight = 1;
};

class CoarseSpace {
 public:
  // Both must outlive this.
  CoarseSpace(const Cloth& cloth, const GridLayout& layout);

  void setTies(std::span<const std::uint32_t> independents,
               std::span<const DependentSlot> dependents);  // forgets the matrix
  // Assembles and factors A_c. `product` is called with a coarse move set: it is to interpolate it (updateDirection
  // with beta 0 and z = 0), to multiply, and to restrict the product. Whether A_c could be factored.
  bool assemble(const std::function<void()>& product);
  bool ready() const { return ready_; }

  // A range's range of P^T r; for different ranges from different threads.
  void restrictResidual(const SlotRange& range, const SlotVectors& r);
  // Sums the restrictions and solves for the coarse move c = A_c^-1 P^T r; returns (P^T r) . c. On one thread.
  double coarseSolve();
  // p = z + beta p + P c, for a range.
  void updateDirection(const SlotRange& range, const SlotVectors& z, float beta, SlotVectors& p) const;

 private:
  using Weights = std::array<double, 3>;
  struct CoarseLines {                         // coarse cells along one side of a piece's grid
    bool smooth = false;                       // splines of second degree; else of first
    std::vector<std::uint32_t> at;             // the fine lines at which cells begin, and at which the last one ends
    std::vector<std::uint32_t> cell;           // per fine line: the cell it lies in,
    std::array<std::vector<float>, 3> weight;  // and there the splines of this number and the next two; padded
    CoarseLines(std::uint32_t fine, double each, bool smooth);
    std::pair<std::uint32_t, Weights> place(double fine) const;                          // the same for any place
    std::uint32_t splines() const { return static_cast<std::uint32_t>(at.size()) + 1; }  // of first degree one is idle
  };
  struct StencilEntry {
    std::uint32_t node = 0;  // coarse
    float weight = 0;
  };
  using Stencil = std::array<StencilEntry, 9>;
  struct CoarseGrid {
    const GridBlock* block = nullptr;  // null: all its nodes are unstructured
    CoarseLines column, row;
    std::uint32_t first = 0;  // coarse node
    std::uint32_t columns() const { return column.splines(); }
    std::uint32_t rows() const { return row.splines(); }
  };
  struct Restriction {  // of a range, onto these coarse nodes; three axes, one after the other
    std::uint32_t first = 0, count = 0;
    std::vector<float> value;
  };
  void addGrid(const ClothPiece& piece, const GridBlock* block);
  Restriction restrictionOf(const SlotRange& range) const;
  std::pair<std::uint32_t, std::uint32_t> coarseRows(const SlotRange& range) const;  // the first, and how many
  void sumRestrictions();  // value_ = the sum of the restrictions
  Stencil stencilAt(const CoarseGrid& grid, double column, double row) const;
  void numberNodes();    // those that move something
  void findCouplings();  // which of them A_c couples
  void colourNodes();    // sets of them that are coupled to no common one

  const Cloth& cloth_;
  const GridLayout& layout_;
  bool smooth_ = false;  // whether P is of quadratic splines
  std::vector<CoarseGrid> grids_;
  std::vector<std::uint32_t> gridOf_;  // per block
  std::uint32_t nodes_ = 0;            // coarse
  std::vector<Stencil> stencils_;      // per slot
  std::vector<float> free_;            // per slot: 1 for an unknown's own, else 0
  std::vector<DependentSlot> dependents_;
  std::vector<std::uint32_t> numberOf_, nodeOf_;     // of coarse nodes that move something, and back
  std::vector<std::vector<std::uint32_t>> around_;   // numbers that a number is coupled to
  std::vector<std::vector<std::uint32_t>> colours_;  // numbers
  std::array<std::vector<float>, 3> value_;          // per coarse node: P^T r, then c
  std::vector<Restriction> restrictions_;            // per range of the layout
  EnvelopeCholesky matrix_;
  std::vector<float> found_;
  bool numbered_ = false, ready_ = false;
};

}  // namespace karinui
