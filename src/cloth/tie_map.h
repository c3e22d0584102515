#pragma once
// Seams as linear constraints that are eliminated (master and slave degrees of freedom). The move u of the nodes is
// u = T q with the moves q of the unknowns: a free node is an unknown of its own, a group sewn 1:1 shares one, the
// single point of a pair sewn 2:1 takes half of each of the pair, a held node has none. Sewn seams cannot open.
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/cloth/cloth.h"

namespace karinui {

class TieMap {
 public:
  struct Term {  // of a row of T
    std::uint32_t unknown = 0;
    double weight = 1;
  };
  // `held` and `tied`: per node and per tie.
  TieMap(const Cloth& cloth, const std::vector<std::uint8_t>& held, const std::vector<std::uint8_t>& tied);

  std::size_t unknowns() const { return unknowns_; }
  std::span<const Term> terms(std::uint32_t node) const {
    return {term_.data() + start_[node], term_.data() + start_[node + 1]};
  }
  // Nodes that move as one.
  const std::vector<std::vector<std::uint32_t>>& groups() const { return members_; }
  // Moves tied nodes so that the constraints hold: groups to their middle (or onto the held node in them), the single
  // point of a pair sewn 2:1 to the pair's middle.
  void enforce(std::vector<Vec3>& position) const;
  // T^T times forces on nodes, and T times moves of unknowns.
  void reduce(std::span<const Vec3> node, std::vector<Vec3>& unknown) const;
  void expand(std::span<const Vec3> unknown, std::vector<Vec3>& node) const;
  // Replaces moves of nodes by such as the constraints allow: each unknown goes by the weighted mean of its nodes.
  void makeAdmissible(std::vector<Vec3>& move) const;

 private:
  struct Mix {  // of groups
    std::uint32_t group = 0;
    double weight = 1;
  };
  Vec3 middleOf(std::uint32_t group, std::span<const Vec3> position) const;

  std::vector<std::uint32_t> group_;                 // per node
  std::vector<std::vector<std::uint32_t>> members_;  // per group
  std::vector<std::uint8_t> groupHeld_, nodeHeld_;
  std::vector<std::uint32_t> sewnGroups_;                              // of several nodes, themselves unknowns
  std::vector<std::pair<std::uint32_t, std::vector<Mix>>> dependent_;  // groups that depend on others, all resolved
  std::size_t unknowns_ = 0;
  std::vector<std::uint32_t> start_;
  std::vector<Term> term_;
};

// A weighted sum of nodes in terms of unknowns, each unknown once.
std::vector<TieMap::Term> termsOf(const TieMap& ties, std::span<const std::uint32_t> nodes,
                                  std::span<const double> weights);

// How far those ties stand open that touch a live piece, metres; and the widest of them, 0 where there are none.
std::vector<double> liveGaps(const Cloth& cloth, std::span<const Vec3> position);
const ClothPiece& pieceOf(const Cloth& cloth, std::uint32_t node);
double widestGap(const Cloth& cloth, std::span<const Vec3> position);
Vec3 gapOf(const Tie& tie, std::span<const Vec3> position);  // from a to b, or to the middle of b and c

}  // namespace karinui
