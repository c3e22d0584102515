#pragma once
// The linear system of one implicit step, solved by preconditioned conjugate gradients (Hestenes and Stiefel 1952). The
// preconditioner is the inverse of the 3x3 diagonal blocks plus a coarse space. In float: it only finds the next move;
// rest is judged in double.
//
// Every node has a slot. The slot of a free node is independent and holds its unknown; of nodes sewn together the first
// one's is. The other slots depend on independent ones: before each product p is expanded to them, after it q is
// reduced from them.
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/coarse_space.h"
#include "cloth/sparse_rows.h"
#include "cloth/tie_map.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"

namespace karinui {

class BlockSystem {
 public:
  // What stays as long as the cloth does. `pairs`: blocks that are new each step; `weights`: constant ones.
  BlockSystem(const Cloth& cloth, const GridLayout& layout, GridBending bending, std::span<const NodePair> pairs,
              std::span<const NodeWeight> weights);
  void setTies(const TieMap& ties);

  GridStiffness& gridStiffness() { return stiffness_; }             // to be filled before `gather`
  void assemble(std::span<const Block3> blocks, Workers& workers);  // starts a new system; a block per pair
  void addDiagonal(std::uint32_t unknown, const Block3& block);     // symmetric
  void setCouplings(std::span<const Coupling> couplings);

  struct StoppingRule {
    int least = 40, most = 400;  // iterations; with a coarse space a quarter of the least is enough
    double tolerance = 0.1;      // error of the move in the norm of the matrix, relative to all that was found
    int uncounted = 0;           // after so many iterations
  };
  // The move for a force on each unknown (newtons); how many iterations it took. Cut short when cancelled.
  int solve(std::span<const Vec3> force, const StoppingRule& rule, const Token& token, Workers& workers,
            std::vector<Vec3>& move);
  // The matrix times a vector of unknowns, for tests.
  std::vector<Vec3> times(std::span<const Vec3> unknown, Workers& workers);
  std::size_t unknowns() const { return slotOf_.size(); }
  std::uint32_t slotOf(std::uint32_t unknown) const { return slotOf_[unknown]; }
  CoarseSpace& coarseSpace() { return coarse_; }  // for tests
  StepMatrix stepMatrix() const { return {stiffness_, bending_, diagonal_, sparse_, couplings_}; }

 private:
  void invertDiagonal(Workers& workers);
  bool coarseMatrixReady(Workers& workers);  // assembled anew when it is due
  std::span<const double> rangeLoads() const { return std::span(load_).subspan(1); }
  // The passes of an iteration, each over the ranges of the layout.
  double multiply(Workers& workers);                                       // q = A p, returns p . q
  void updateResidual(float alpha, bool coarse, Workers& workers);         // r -= alpha q, and its restriction
  double applyPreconditioner(float alpha, bool coarse, Workers& workers);  // d += alpha p, z = M r; returns r . z
  void updateDirection(float beta, bool coarse, Workers& workers);         // p = z + beta p

  const GridLayout& layout_;
  GridBending bending_;
  GridStiffness stiffness_;
  SparseRows sparse_;
  CoarseSpace coarse_;
  int age_ = 0, iterations_ = 0, iterationsWhenNew_ = 0;  // of the coarse space's matrix, in solves; of the last solve
  std::vector<std::uint32_t> slotOf_;                     // slot of each unknown
  std::vector<std::uint8_t> free_;                        // per slot: whether it is one
  std::vector<DependentSlot> dependents_;                 // sorted by slot, then by independent
  Couplings couplings_;
  std::vector<double> load_;  // work before each range, and before all of them the coarse solve
  std::vector<double> sums_;  // of the coarse solve and the ranges
  DiagonalBlocks diagonal_, inverse_;
  SlotVectors d_, r_, z_, p_, q_;
};

}  // namespace karinui
