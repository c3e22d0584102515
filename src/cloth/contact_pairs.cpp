#include "cloth/contact_pairs.h"

#include <cmath>

#include "cloth/closest_points.h"

namespace karinui {
namespace {

constexpr double kEdgeReach = 0.75;     // in longest edges: how far the nearest corners of a pair can lie apart
constexpr double kLongestEdge = 3;      // spacings: a longer edge counts as this long
constexpr double kPaperNear = 1.5;      // radii: what is nearer on paper is not pushed apart in a sharp fold
constexpr double kMoveReach = 1.2;      // times the relative move by which a pair may come nearer
constexpr double kNodeMoveReach = 1.5;  // the same for the two nodes of the list that stand for the pair,
constexpr double kNodeReach = 0.25;     // and so many spacings more
constexpr double kLeastGap = 1e-9;      // metres: below it the normal is unknown
constexpr std::size_t kBlock = 128;

}  // namespace

void ContactPairs::measureEdges(std::span<const Vec3> x) {
  // One torn edge must not make every pair near: such a place is coarse anyway.
  const double most = kLongestEdge * kLongestEdge * spacing_ * spacing_;
  longest_ = 0;
  longestEdge_.assign(x.size(), 0);
  for (const auto& [a, b] : topology_.edges) {
    const double own = squaredLength(x[b] - x[a]), length = own < most ? own : most;  // not a number: the most
    longestEdge_[a] = std::max(longestEdge_[a], length);
    longestEdge_[b] = std::max(longestEdge_[b], length);
    longest_ = std::max(longest_, length);
  }
  for (double& length : longestEdge_) length = std::sqrt(length);
  longest_ = std::sqrt(longest_);
}

// Each pair is found once, from its two nearest nodes: `takes` is whether another two nodes, nearer to each other, find
// it. Neighbours find nothing; where a sharp fold squeezes them so that they are the nearest, the next nearest do, and
// then what lies near on paper, too, is not pushed apart.
bool ContactPairs::takes(NodeIndex a, NodeIndex b, bool& squeezed) const {
  if (!topology_.neighbours(a, b)) return true;
  squeezed = true;
  return false;
}

bool ContactPairs::nearOnPaper(const ContactPair& pair) const {
  Flat apart;
  for (int k = 0; k < 4; ++k) apart = apart + topology_.paper[pair.node[k]] * pair.weight[k];
  return topology_.piece[pair.node[0]] != topology_.piece[pair.node[3]] || length(apart) < kPaperNear * radius_;
}

bool ContactPairs::keeps(const ContactPair& pair, const Search& search, bool squeezed) const {
  return !(squeezed && search.move.empty() && nearOnPaper(pair));
}

void ContactPairs::nodeFaces(NodeIndex a, NodeIndex b, const Search& search, std::vector<ContactPair>& out) const {
  const Vec3 p = search.x[a];
  const double toB = squaredLength(p - search.x[b]);
  for (const std::uint32_t f : topology_.facesOf.of(b)) {
    const Triangle& face = topology_.faces[f];
    bool mine = true, squeezed = false;  // whether b is the face's nearest corner
    double apart = 0;
    for (NodeIndex c : face) {
      const double toC = squaredLength(p - search.x[c]);
      if (topology_.sewn(c, a) || (c != b && (toC < toB || (toC == toB && c < b)) && takes(a, c, squeezed)))
        mine = false;
      if (!search.move.empty()) apart = std::fmax(apart, squaredLength(search.move[a] - search.move[c]));
    }
    if (!mine) continue;
    const auto w = closestOnTriangle(p, search.x[face[0]], search.x[face[1]], search.x[face[2]]);
    const Vec3 d = p - (search.x[face[0]] * w[0] + search.x[face[1]] * w[1] + search.x[face[2]] * w[2]);
    const double gap = length(d);
    if (!(gap < search.within + kMoveReach * std::sqrt(apart) && gap > kLeastGap)) continue;
    const ContactPair pair{{a, face[0], face[1], face[2]}, {1, -w[0], -w[1], -w[2]}, 1, d * (1 / gap), gap};
    if (keeps(pair, search, squeezed)) out.push_back(pair);
  }
}

void ContactPairs::edgeEdges(NodeIndex a, NodeIndex b, const Search& search, std::vector<ContactPair>& out) const {
  const Vec3 pa = search.x[a], pb = search.x[b];
  const double both = squaredLength(pa - pb);
  const auto other = [&](std::uint32_t e, NodeIndex k) {
    return topology_.edges[e][0] == k ? topology_.edges[e][1] : topology_.edges[e][0];
  };
  for (const std::uint32_t edgeA : topology_.edgesOf.of(a)) {
    const NodeIndex a2 = other(edgeA, a);
    const Vec3 pa2 = search.x[a2];
    const double cross1 = squaredLength(pa2 - pb);
    if (topology_.sewn(a2, b)) continue;
    bool squeezed1 = false;
    if ((cross1 < both || (cross1 == both && a2 < a)) && takes(a2, b, squeezed1)) continue;
    for (const std::uint32_t edgeB : topology_.edgesOf.of(b)) {
      const NodeIndex b2 = other(edgeB, b);
      if (topology_.sewn(a2, b2) || topology_.sewn(b2, a)) continue;
      const Vec3 pb2 = search.x[b2];
      const double cross2 = squaredLength(pb2 - pa);
      bool squeezed = squeezed1;
      if ((cross2 < both || (cross2 == both && b2 < b)) && takes(a, b2, squeezed)) continue;
      if (squaredLength(pa2 - pb2) < both && takes(a2, b2, squeezed)) continue;
      const auto at = closestOnSegments(pa, pa2, pb, pb2);
      // At an edge's end the node-face pair answers.
      if (search.move.empty() && (at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1)) continue;
      const Vec3 d = lerp(pa, pa2, at[0]) - lerp(pb, pb2, at[1]);
      double apart = 0;
      if (!search.move.empty())
        for (NodeIndex m : {a, a2})
          for (NodeIndex n : {b, b2}) apart = std::fmax(apart, squaredLength(search.move[m] - search.move[n]));
      const double gap = length(d);
      if (!(gap < search.within + kMoveReach * std::sqrt(apart) && gap > kLeastGap)) continue;
      const ContactPair pair{{a, a2, b, b2}, {1 - at[0], at[0], at[1] - 1, -at[1]}, 2, d * (1 / gap), gap};
      if (keeps(pair, search, squeezed)) out.push_back(pair);
    }
  }
}

std::vector<ContactPair> ContactPairs::find(const Search& search, Workers& workers) {
  double most = 0;
  for (Vec3 m : search.move) most = std::fmax(most, squaredLength(m));
  const double still = search.within + kEdgeReach * longest_;
  const double reach = still + 2 * kMoveReach * std::sqrt(most);
  list_.update(search.x, reach, workers);
  const auto& list = list_.pairs();
  std::vector<std::vector<ContactPair>> found((list.size() + kBlock - 1) / kBlock);
  workers.forBlocks(list.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = found[begin / kBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto [a, b] = list[n];
      const double d2 = squaredLength(search.x[b] - search.x[a]);
      if (d2 > reach * reach) continue;
      double far = search.within + kEdgeReach * std::fmax(longestEdge_[a], longestEdge_[b]);
      // The nodes of a pair move nearly alike, so the moves of these two bound it, with some margin.
      if (!search.move.empty()) far += kNodeReach * spacing_ + kNodeMoveReach * length(search.move[a] - search.move[b]);
      if (d2 > far * far) continue;
      if (!leftOut_.empty() && leftOut_[a] && leftOut_[b]) continue;
      nodeFaces(a, b, search, out);
      nodeFaces(b, a, search, out);
      edgeEdges(a, b, search, out);
    }
  });
  std::vector<ContactPair> all;
  for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace karinui
