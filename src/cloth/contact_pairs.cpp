#include "cloth/contact_pairs.h"

#include <cmath>
#include <numeric>

#include "cloth/closest_points.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kEdgeReach = 0.75;     // in longest edges: how far the nearest corners of a pair can lie apart
constexpr double kLongestEdge = 3;      // spacings: a longer edge counts as this long
constexpr double kPaperNear = 1.5;      // radii: what is nearer on paper is not pushed apart in a sharp fold
constexpr double kMoveReach = 1.2;      // times the relative move by which a pair may come nearer
constexpr double kNodeMoveReach = 1.5;  // the same for the two nodes of the list that stand for the pair,
constexpr double kNodeReach = 0.25;     // and so many spacings more
constexpr double kLeastGap = 1e-9;      // metres: below it the normal is unknown
constexpr double kRounding = 1e-9;      // metres, of the bound below

// A plane across the way between the nearest nodes of two sides bounds their distance from below, for far less than
// their closest points cost. `low`, `high`: the least of the one side and the most of the other along that way.
bool fartherThan(double reach, double low, double high, double way) { return low - high > (reach + kRounding) * way; }

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

void ContactPairs::measureSheets(const Search& search) {
  normal_.assign(search.x.size(), {});
  for (const Triangle& face : topology_.faces) {
    const Vec3 n = cross(search.x[face[1]] - search.x[face[0]], search.x[face[2]] - search.x[face[0]]);
    for (NodeIndex k : face) normal_[k] += n;
  }
  for (Vec3& n : normal_) n = normalized(n);
  spread_.assign(search.x.size(), 0);
  if (search.move.empty()) return;
  for (const auto& [a, b] : topology_.edges) {
    const double apart = squaredLength(search.move[a] - search.move[b]);
    spread_[a] = std::max(spread_[a], apart);
    spread_[b] = std::max(spread_[b], apart);
  }
  for (double& spread : spread_) spread = std::sqrt(spread);
}

// Whether a plane along the sheets keeps all faces at a from all faces at b, so that the two find no pair. In layers
// that lie over one another two nodes in three end here.
bool ContactPairs::sheetsApart(NodeIndex a, NodeIndex b, const Search& search) const {
  double reach = search.within + kRounding;
  if (!search.move.empty())
    reach += (1 + kRounding) * kMoveReach * (spread_[a] + spread_[b] + length(search.move[a] - search.move[b]));
  const Vec3 origin = search.x[b], between = search.x[a] - origin;
  const auto farthest = [&](NodeIndex own, Vec3 way) {  // of the faces at a node, from the origin
    double most = dot(search.x[own] - origin, way);
    for (const std::uint32_t e : topology_.edgesOf.of(own))
      for (NodeIndex end : topology_.edges[e]) most = std::max(most, dot(search.x[end] - origin, way));
    return most;
  };
  const Vec3 na = normal_[a], nb = normal_[b];
  for (Vec3 n : {dot(na, nb) < 0 ? na - nb : na + nb, na, nb}) {
    if (dot(between, n) < 0) n = -n;
    const double apart = reach * length(n);
    if (dot(between, n) <= apart) continue;
    const double high = farthest(b, n);
    if (dot(between, n) - high > apart && -farthest(a, -n) - high > apart) return true;
  }
  return false;
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
  const Vec3 p = search.x[a], between = p - search.x[b];
  const double toB = squaredLength(between), way = std::sqrt(toB), low = dot(p, between);
  for (const std::uint32_t f : topology_.facesOf.of(b)) {
    const Triangle& face = topology_.faces[f];
    bool mine = true, squeezed = false;  // whether b is the face's nearest corner
    for (NodeIndex c : face) {
      if (c == b) continue;
      const double toC = squaredLength(p - search.x[c]);
      if ((toC < toB || (toC == toB && c < b)) && takes(a, c, squeezed)) mine = false;
    }
    if (!mine) continue;
    double apart = 0, high = -1e300;
    for (NodeIndex c : face) {
      high = std::max(high, dot(search.x[c], between));
      if (!search.move.empty()) apart = std::max(apart, squaredLength(search.move[a] - search.move[c]));
    }
    const double reach = search.within + kMoveReach * std::sqrt(apart);
    if (fartherThan(reach, low, high, way)) continue;
    if (topology_.sewn(face[0], a) || topology_.sewn(face[1], a) || topology_.sewn(face[2], a)) continue;
    const auto w = closestOnTriangle(p, search.x[face[0]], search.x[face[1]], search.x[face[2]]);
    const Vec3 d = p - (search.x[face[0]] * w[0] + search.x[face[1]] * w[1] + search.x[face[2]] * w[2]);
    const double gap = length(d);
    if (!(gap < reach && gap > kLeastGap)) continue;
    const ContactPair pair{{a, face[0], face[1], face[2]}, {1, -w[0], -w[1], -w[2]}, 1, d * (1 / gap), gap};
    if (keeps(pair, search, squeezed)) out.push_back(pair);
  }
}

// The edges at `own` whose far end is no nearer to `other` than `own` is: none else is of a pair that `own` finds.
void ContactPairs::facingEdges(NodeIndex own, NodeIndex other, const Search& search,
                               std::vector<FacingEdge>& out) const {
  out.clear();
  const Vec3 far = search.x[other];
  const double both = squaredLength(search.x[own] - far);
  for (const std::uint32_t e : topology_.edgesOf.of(own)) {
    const NodeIndex end = topology_.edges[e][0] == own ? topology_.edges[e][1] : topology_.edges[e][0];
    FacingEdge facing{end, search.x[end]};
    const double crosswise = squaredLength(facing.place - far);
    if ((crosswise < both || (crosswise == both && end < own)) && takes(end, other, facing.squeezed)) continue;
    if (topology_.sewn(end, other)) continue;
    out.push_back(facing);
  }
}

void ContactPairs::edgeEdges(NodeIndex a, NodeIndex b, const Search& search, std::vector<ContactPair>& out) const {
  const Vec3 pa = search.x[a], pb = search.x[b], between = pa - pb;
  const double both = squaredLength(between), way = std::sqrt(both), aAlong = dot(pa, between),
               bAlong = dot(pb, between);
  thread_local std::vector<FacingEdge> edgesA, edgesB;
  facingEdges(a, b, search, edgesA);
  if (edgesA.empty()) return;
  facingEdges(b, a, search, edgesB);
  for (const FacingEdge& edgeA : edgesA) {
    const NodeIndex a2 = edgeA.end;
    const Vec3 pa2 = edgeA.place;
    const double low = std::min(aAlong, dot(pa2, between));
    for (const FacingEdge& edgeB : edgesB) {
      const NodeIndex b2 = edgeB.end;
      const Vec3 pb2 = edgeB.place;
      bool squeezed = edgeA.squeezed || edgeB.squeezed;
      if (squaredLength(pa2 - pb2) < both && takes(a2, b2, squeezed)) continue;
      double apart = 0;
      if (!search.move.empty())
        for (NodeIndex m : {a, a2})
          for (NodeIndex n : {b, b2}) apart = std::max(apart, squaredLength(search.move[m] - search.move[n]));
      const double reach = search.within + kMoveReach * std::sqrt(apart);
      if (fartherThan(reach, low, std::max(bAlong, dot(pb2, between)), way)) continue;
      if (topology_.sewn(a2, b2)) continue;
      const auto at = closestOnSegments(pa, pa2, pb, pb2);
      // At an edge's end the node-face pair answers.
      if (search.move.empty() && (at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1)) continue;
      const Vec3 d = lerp(pa, pa2, at[0]) - lerp(pb, pb2, at[1]);
      const double gap = length(d);
      if (!(gap < reach && gap > kLeastGap)) continue;
      const ContactPair pair{{a, a2, b, b2}, {1 - at[0], at[0], at[1] - 1, -at[1]}, 2, d * (1 / gap), gap};
      if (keeps(pair, search, squeezed)) out.push_back(pair);
    }
  }
}

std::vector<ContactPair> ContactPairs::find(const Search& search, Workers& workers) {
  return this->search(search, {}, workers);
}

std::vector<ContactPair> ContactPairs::findAgain(const Search& search, const std::vector<std::uint8_t>& moved,
                                                 Workers& workers) {
  std::vector<std::uint8_t> stale = moved;  // what is found at two nodes depends on the moves of their faces' corners
  for (const Triangle& face : topology_.faces)
    if (moved[face[0]] || moved[face[1]] || moved[face[2]])
      for (NodeIndex k : face) stale[k] = 1;
  return this->search(search, stale, workers);
}

// `stale`: the nodes at which what was found last no longer holds; empty: all.
std::vector<ContactPair> ContactPairs::search(const Search& search, const std::vector<std::uint8_t>& stale,
                                              Workers& workers) {
  measureSheets(search);
  double most = 0;
  for (Vec3 m : search.move) most = std::fmax(most, squaredLength(m));
  const double still = search.within + kEdgeReach * longest_;
  const double reach = still + 2 * kMoveReach * std::sqrt(most);
  const bool listIsNew = list_.update(search.x, reach, workers);
  const auto& list = list_.pairs();
  const bool again = !stale.empty() && !listIsNew && asked_.size() == list.size();
  std::vector<std::uint32_t> start(list.size() + 1, 0);
  std::vector<std::uint8_t> asked(list.size(), 0);
  std::vector<std::vector<ContactPair>> found((list.size() + kPairBlock - 1) / kPairBlock);
  workers.forBlocks(list.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = found[begin / kPairBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto [a, b] = list[n];
      const double d2 = squaredLength(search.x[b] - search.x[a]);
      if (d2 > reach * reach) continue;
      asked[n] = 1;
      if (again && asked_[n] && !stale[a] && !stale[b]) {
        out.insert(out.end(), last_.begin() + start_[n], last_.begin() + start_[n + 1]);
        start[n + 1] = start_[n + 1] - start_[n];
        continue;
      }
      double far = search.within + kEdgeReach * std::fmax(longestEdge_[a], longestEdge_[b]);
      // The nodes of a pair move nearly alike, so the moves of these two bound it, with some margin.
      if (!search.move.empty()) far += kNodeReach * spacing_ + kNodeMoveReach * length(search.move[a] - search.move[b]);
      if (d2 > far * far) continue;
      if (!leftOut_.empty() && leftOut_[a] && leftOut_[b]) continue;
      if (sheetsApart(a, b, search)) continue;
      const std::size_t before = out.size();
      nodeFaces(a, b, search, out);
      nodeFaces(b, a, search, out);
      edgeEdges(a, b, search, out);
      start[n + 1] = static_cast<std::uint32_t>(out.size() - before);
    }
  });
  std::vector<ContactPair> all;
  for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
  if (!search.move.empty()) {
    std::partial_sum(start.begin(), start.end(), start.begin());
    start_ = std::move(start);
    asked_ = std::move(asked);
    last_ = all;
  }
  return all;
}

}  // namespace karinui
