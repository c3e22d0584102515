#pragma once
// The coarse level of a two-level additive preconditioner, M^-1 = D^-1 + P A_c^-1 P^T (Smith, Bjorstad, Gropp: Domain
// Decomposition, 1996, chapter 1). Conjugate gradients with the diagonal D alone pass a force on from node to node, one
// iteration each, so that long waves take hundreds. The coarse nodes lie on a grid, one for every six lattice nodes
// each way (fewer in very fine cloth); P interpolates between them (coarse_grid.h), and the Galerkin matrix
// A_c = P^T A P (galerkin_matrix.h) is factored.
//
// A_c may be older than the step's A: that costs iterations, not accuracy.
#include <array>
#include <span>
#include <vector>

#include "cloth/galerkin_matrix.h"

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
  bool assemble(const StepMatrix& step, Workers& workers);  // and factors A_c; whether it could be
  bool ready() const { return ready_; }

  // A range's range of P^T r; for different ranges from different threads.
  void restrictResidual(const SlotRange& range, const SlotVectors& r);
  // Sums the restrictions and solves for the coarse move c = A_c^-1 P^T r; returns (P^T r) . c. On one thread.
  double coarseSolve();
  // p = z + beta p + P c, for a range.
  void updateDirection(const SlotRange& range, const SlotVectors& z, float beta, SlotVectors& p) const;

 private:
  struct Restriction {  // of a range, onto these coarse nodes; three axes, one after the other
    std::uint32_t first = 0, count = 0;
    std::vector<float> value;
  };
  void addGrid(const ClothPiece& piece, const GridBlock* block);
  Restriction restrictionOf(const SlotRange& range) const;
  std::pair<std::uint32_t, std::uint32_t> coarseRows(const SlotRange& range) const;  // the first, and how many
  using Neighbours = std::vector<std::vector<std::uint32_t>>;  // of each number those that A_c couples it to
  void sumRestrictions();                                      // value_ = the sum of the restrictions
  void findSupported();                                        // and which of them faces couple
  void number(const Couplings& couplings);                     // for a narrow envelope
  std::size_t renumber(const Neighbours& around);              // how much A_c then stores
  void addContacts(const Couplings& couplings, Neighbours& around) const;
  void findRows();  // of P

  const Cloth& cloth_;
  const GridLayout& layout_;
  std::vector<CoarseGrid> grids_;
  std::vector<std::uint32_t> gridOf_;    // per block
  std::uint32_t nodes_ = 0;              // coarse
  std::vector<CoarseStencil> stencils_;  // per slot
  std::vector<float> free_;              // per slot: 1 for an unknown's own, else 0
  std::vector<DependentSlot> dependents_;
  std::vector<std::uint32_t> supported_;          // coarse nodes that move something
  Neighbours overFaces_;                          // by their places in it
  std::vector<std::uint32_t> numberOf_, nodeOf_;  // of coarse nodes that move something, and back
  Interpolation interpolation_;
  std::array<std::vector<float>, 3> value_;  // per coarse node: P^T r, then c
  std::vector<Restriction> restrictions_;    // per range of the layout
  GalerkinMatrix galerkin_;
  EnvelopeCholesky matrix_;
  std::vector<float> found_;
  bool numbered_ = false, ready_ = false;
  bool coupled_ = false;  // whether the numbers, and what is stored, are those of cloth in contact
};

}  // namespace karinui
