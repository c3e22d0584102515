#pragma once
// One interface for all that stores energy in cloth: its value and its gradient, and for those that lie in no grid
// block a positive semidefinite approximation of the second derivative as 3x3 blocks between pairs of nodes. Each
// output is written by one block of work, so the bits do not depend on the number of threads.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/geometry/vec.h"

namespace karinui {

using NodeIndex = std::uint32_t;
struct NodePair {
  NodeIndex row = 0, column = 0;
};
using Block3 = std::array<float, 9>;  // row by row; in float, as it only finds moves and never judges rest

class Energy {
 public:
  virtual ~Energy() = default;
  virtual double value(std::span<const Vec3> x, Workers& workers) const = 0;                                // joules
  virtual void addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const = 0;  // newtons
};

class BlockEnergy : public Energy {
 public:
  virtual void appendPairs(std::vector<NodePair>& pairs) const = 0;
  virtual std::size_t pairCount() const = 0;
  virtual void blocks(std::span<const Vec3> x, std::span<Block3> out, Workers& workers) const = 0;  // as appendPairs
};

// The sum over many small elements of K nodes each. `Self` has elementValue, elementGradient and elementBlocks, which
// are no virtual calls.
template <class Self, int K>
class ElementEnergy : public BlockEnergy {
 public:
  double value(std::span<const Vec3> x, Workers& workers) const override {
    return workers.sum(nodes_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      double total = 0;
      for (std::size_t e = begin; e < end; ++e) total += self().elementValue(e, corners(x, e));
      return total;
    });
  }
  void addGradient(std::span<const Vec3> x, std::span<Vec3> gradient, Workers& workers) const override {
    force_.resize(nodes_.size() * K);
    workers.forBlocks(nodes_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        self().elementGradient(e, corners(x, e), std::span<Vec3, K>(&force_[e * K], K));
    });
    workers.forBlocks(node_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        Vec3 sum;
        for (std::uint32_t c = start_[k]; c < start_[k + 1]; ++c) sum += force_[item_[c]];
        gradient[node_[k]] += sum;
      }
    });
  }
  void appendPairs(std::vector<NodePair>& pairs) const override {
    for (const auto& n : nodes_)
      for (int a = 0; a < K; ++a)
        for (int b = 0; b < K; ++b) pairs.push_back({n[a], n[b]});
  }
  std::size_t pairCount() const override { return nodes_.size() * K * K; }
  void blocks(std::span<const Vec3> x, std::span<Block3> out, Workers& workers) const override {
    workers.forBlocks(nodes_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) self().elementBlocks(e, corners(x, e), out.subspan(e * K * K, K * K));
    });
  }
  std::size_t count() const { return nodes_.size(); }

 protected:
  using Corners = std::array<Vec3, K>;
  void setElements(std::vector<std::array<NodeIndex, K>> nodes, std::size_t nodeCount) {
    nodes_ = std::move(nodes);
    std::vector<std::uint32_t> first(nodeCount + 1, 0);
    for (const auto& n : nodes_)
      for (NodeIndex k : n) ++first[k + 1];
    for (std::size_t k = 0; k < nodeCount; ++k) first[k + 1] += first[k];
    item_.resize(nodes_.size() * K);
    std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
    for (std::uint32_t c = 0; c < item_.size(); ++c) item_[fill[nodes_[c / K][c % K]]++] = c;
    node_.clear();
    start_.assign(1, 0);
    for (NodeIndex k = 0; k < nodeCount; ++k)
      if (first[k + 1] > first[k]) {
        node_.push_back(k);
        start_.push_back(first[k + 1]);
      }
  }
  std::vector<std::array<NodeIndex, K>> nodes_;

 private:
  static constexpr std::size_t kBlock = 512;
  const Self& self() const { return static_cast<const Self&>(*this); }
  Corners corners(std::span<const Vec3> x, std::size_t e) const {
    Corners c;
    for (int a = 0; a < K; ++a) c[a] = x[nodes_[e][a]];
    return c;
  }
  std::vector<NodeIndex> node_;              // nodes that have elements
  std::vector<std::uint32_t> start_, item_;  // and their places in force_
  mutable std::vector<Vec3> force_;          // scratch; one caller at a time, as Workers
};

// block += a I + b n n^T
inline void addIdentityAndOuter(Block3& block, double a, double b, Vec3 n) {
  block[0] += static_cast<float>(a + b * n.x * n.x);
  block[1] += static_cast<float>(b * n.x * n.y);
  block[2] += static_cast<float>(b * n.x * n.z);
  block[3] += static_cast<float>(b * n.y * n.x);
  block[4] += static_cast<float>(a + b * n.y * n.y);
  block[5] += static_cast<float>(b * n.y * n.z);
  block[6] += static_cast<float>(b * n.z * n.x);
  block[7] += static_cast<float>(b * n.z * n.y);
  block[8] += static_cast<float>(a + b * n.z * n.z);
}
inline void addOuter(Block3& block, double s, Vec3 a, Vec3 b) {
  const Vec3 c = a * s;
  block[0] += static_cast<float>(c.x * b.x);
  block[1] += static_cast<float>(c.x * b.y);
  block[2] += static_cast<float>(c.x * b.z);
  block[3] += static_cast<float>(c.y * b.x);
  block[4] += static_cast<float>(c.y * b.y);
  block[5] += static_cast<float>(c.y * b.z);
  block[6] += static_cast<float>(c.z * b.x);
  block[7] += static_cast<float>(c.z * b.y);
  block[8] += static_cast<float>(c.z * b.z);
}

}  // namespace karinui
