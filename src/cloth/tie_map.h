#pragma once
// How nodes move together. Every node's move is a fixed mix of free unknowns: itself when untied, the shared one of its
// group when sewn 1:1, half of each of the folded pair when sewn 2:1, none when held. Sewn seams therefore cannot open.
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/cloth/cloth.h"

namespace karinui {

class TieMap {
 public:
  struct Part {
    std::uint32_t unknown = 0;
    double weight = 1;
  };
  // `held` and `tied`: per node and per tie.
  TieMap(const Cloth& cloth, const std::vector<std::uint8_t>& held, const std::vector<std::uint8_t>& tied);

  std::size_t unknowns() const { return unknowns_; }
  std::span<const Part> parts(std::uint32_t node) const {
    return {part_.data() + start_[node], part_.data() + start_[node + 1]};
  }
  // Nodes that move as one.
  const std::vector<std::vector<std::uint32_t>>& groups() const { return members_; }
  // Moves tied nodes to where their ties want them: groups to their middle (or onto the held node in them), the single
  // point of a folded pair to the pair's middle.
  void gather(std::vector<Vec3>& position) const;
  // Sums node values onto unknowns (of forces), and spreads moves of unknowns onto nodes.
  void reduce(std::span<const Vec3> node, std::vector<Vec3>& unknown) const;
  void spread(std::span<const Vec3> unknown, std::vector<Vec3>& node) const;
  // Makes moves wished for nodes such as ties allow: each unknown goes by the mean of what its nodes wish.
  void share(std::vector<Vec3>& move) const;

 private:
  struct Mix {  // of groups
    std::uint32_t group = 0;
    double weight = 1;
  };
  Vec3 middleOf(std::uint32_t group, std::span<const Vec3> position) const;

  std::vector<std::uint32_t> group_;                 // per node
  std::vector<std::vector<std::uint32_t>> members_;  // per group
  std::vector<std::uint8_t> groupHeld_, nodeHeld_;
  std::vector<std::uint32_t> several_;                                // groups of several nodes that no others give
  std::vector<std::pair<std::uint32_t, std::vector<Mix>>> follower_;  // groups given by others, all resolved
  std::size_t unknowns_ = 0;
  std::vector<std::uint32_t> start_;
  std::vector<Part> part_;
};

// Parts of a weighted sum of nodes in terms of unknowns, each unknown once.
std::vector<TieMap::Part> partsOf(const TieMap& ties, std::span<const std::uint32_t> nodes,
                                  std::span<const double> weights);

// How far those ties stand open that touch a live piece, metres; and the widest of them, 0 where there are none.
std::vector<double> liveGaps(const Cloth& cloth, std::span<const Vec3> position);
double widestGap(const Cloth& cloth, std::span<const Vec3> position);
Vec3 gapOf(const Tie& tie, std::span<const Vec3> position);  // from a to b, or to the middle of b and c

}  // namespace karinui
