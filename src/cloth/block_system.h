#pragma once
// The linear system of one implicit step: 3x3 blocks between unknowns in rows, gathered from the energies' blocks,
// solved by conjugate gradients with the inverse 3x3 diagonal as preconditioner. In float: it only finds the next move;
// rest is judged in double.
//
// Blocks are stored rather than recomputed per product: one layout then serves lattice, ring, ties and every energy.
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/energy.h"
#include "cloth/tie_map.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"

namespace karinui {

struct Lane {
  using Float4 = float __attribute__((vector_size(16)));
  Float4 v{};
};

// A contact between bits of cloth: `along` n n^T + `across` (I - n n^T) on the weighted sum of its unknowns.
struct Coupling {
  std::vector<TieMap::Part> parts;
  Vec3 normal;
  double along = 0, across = 0;  // N/m
};

class BlockSystem {
 public:
  // Rows for these pairs of nodes under these ties. `changing` get new blocks each step; `constant` have theirs for
  // good.
  BlockSystem(const TieMap& ties, std::span<const NodePair> changing, std::span<const NodePair> constant,
              std::span<const Block3> constantBlocks);

  void gather(std::span<const Block3> changingBlocks, Workers& workers);  // starts a new system
  void addDiagonal(std::uint32_t unknown, const Block3& block);
  void setCouplings(std::vector<Coupling> couplings) { couplings_ = std::move(couplings); }

  struct Stop {
    int least = 40, most = 150;
    double tolerance = 0.2;  // in the preconditioned norm
  };
  // The move for a force on each unknown (newtons); how many iterations it took. Cut short when cancelled.
  int solve(std::span<const Vec3> force, const Stop& stop, const Token& token, Workers& workers,
            std::vector<Vec3>& move);
  std::size_t unknowns() const { return rowStart_.size() - 1; }

 private:
  struct Columns {  // of a 3x3 block, padded
    Lane x, y, z;
  };
  struct Source {
    std::uint32_t pair = 0;
    float weight = 1;
  };
  void invertDiagonal(Workers& workers);
  double multiply(const std::vector<Lane>& p, std::vector<Lane>& q, Workers& workers) const;  // q = A p, returns p.q

  std::vector<std::uint32_t> rowStart_, column_, diagonal_;
  std::vector<Columns> value_, constant_, inverse_;
  std::vector<std::uint32_t> sourceStart_;  // of each slot
  std::vector<Source> source_;
  std::vector<Coupling> couplings_;
  std::vector<Lane> r_, z_, p_, q_, d_;
};

}  // namespace karinui
