#pragma once
// The linear system of one implicit step, solved by conjugate gradients with the inverse 3x3 diagonal and a coarse
// space as preconditioner. In float: it only finds the next move; rest is judged in double.
//
// Unknowns live in slots, as nodes do: a free node's unknown is at home in the node's own slot, that of nodes sewn
// together in the first one's. The others are guests: before each product they are given their mix of the homes, after
// it they hand back what they felt.
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/coarse_space.h"
#include "cloth/sparse_rows.h"
#include "cloth/tie_map.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"

namespace karinui {

// A contact between bits of cloth: `along` n n^T + `across` (I - n n^T) on the weighted sum of its unknowns.
struct Coupling {
  std::vector<TieMap::Part> parts;
  Vec3 normal;
  double along = 0, across = 0;  // N/m
};

class BlockSystem {
 public:
  // What stays as long as the cloth does. `pairs`: blocks that are new each step; `weights`: constant ones.
  BlockSystem(const Cloth& cloth, const PanelPlan& plan, PanelBending bending, std::span<const NodePair> pairs,
              std::span<const NodeWeight> weights);
  void setTies(const TieMap& ties);

  PanelStiffness& panels() { return panels_; }                    // to be filled before `gather`
  void gather(std::span<const Block3> blocks, Workers& workers);  // starts a new system; a block per pair
  void addDiagonal(std::uint32_t unknown, const Block3& block);   // symmetric
  void setCouplings(std::vector<Coupling> couplings) { couplings_ = std::move(couplings); }

  struct Stop {
    int least = 40, most = 400;  // with a coarse space an eighth of the least is enough
    double tolerance = 0.1;      // of the move, in the matrix's own norm
  };
  // The move for a force on each unknown (newtons); how many iterations it took. Cut short when cancelled.
  int solve(std::span<const Vec3> force, const Stop& stop, const Token& token, Workers& workers,
            std::vector<Vec3>& move);
  // The matrix times a vector of unknowns, for those who want to look.
  std::vector<Vec3> times(std::span<const Vec3> unknown, Workers& workers);
  std::size_t unknowns() const { return home_.size(); }

 private:
  void invertDiagonal(Workers& workers);
  bool coarseReady(Workers& workers);  // made new when it is due
  std::span<const double> parts() const { return std::span(load_).subspan(1); }
  // The jobs of an iteration, each over the plan's parts.
  double multiply(std::span<const Coupling> couplings, Workers& workers);  // q = A p, returns p . q
  void shorten(float alpha, bool coarse, Workers& workers);                // r -= alpha q, and what coarse moves feel
  double precondition(float alpha, bool coarse, Workers& workers);         // d += alpha p, z = M r; returns r . z
  void turn(float beta, bool coarse, Workers& workers);                    // p = z + beta p

  const PanelPlan& plan_;
  PanelBending bending_;
  PanelStiffness panels_;
  SparseRows sparse_;
  CoarseSpace coarse_;
  int age_ = 0, iterations_ = 0, iterationsWhenNew_ = 0;  // of the coarse space's matrix, in solves; of the last solve
  std::vector<std::uint32_t> home_;                       // slot of each unknown
  std::vector<std::uint8_t> free_;                        // per slot: whether it is one
  std::vector<Guest> guests_;                             // by slot, then home
  std::vector<Coupling> couplings_;
  std::vector<double> load_;  // of what comes before each part, and before them the coarse space's answer
  std::vector<double> sums_;  // of the answer and the parts
  OwnBlocks own_, inverse_;
  Lanes3 d_, r_, z_, p_, q_;
};

}  // namespace karinui
