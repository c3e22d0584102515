#include "cloth/contact_pairs.h"

#include <cmath>
#include <numeric>

#include "cloth/closest_points.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kEdgeReach = 0.75;      // in longest edges: how far the nearest corners of a pair can lie apart
constexpr double kLongestEdge = 3;       // spacings: a longer edge counts as this long
constexpr double kPaperNear = 1.5;       // radii: what is nearer on paper is not pushed apart in a sharp fold
constexpr double kMoveReach = 1.2;       // times the relative move by which a pair may come nearer
constexpr double kCandidateReach = 3;    // radii: nearer pairs are kept with the list,
constexpr double kCandidateCell = 0.25;  // but only so many spacings beyond the radius: a flat sheet has none
constexpr std::size_t kWornShare = 8;    // the list is made anew once an eighth of it was examined without candidates
constexpr std::uint8_t kOppositeSides = 2 | 4 | 8;  // all ends are neighbours but for the first of each
constexpr double kLeastGap = 1e-9;                  // metres: below it the normal is unknown
constexpr double kRounding = 1e-9;                  // metres, of the bounds
constexpr double kFarApart = 1e9;                   // metres

// Closest points of a pair's two sides, and the way from the second to the first.
struct Closest {
  std::array<double, 4> weight{};
  bool atEnd = false;  // of an edge
  Vec3 way;
};

Closest closestOf(const std::array<NodeIndex, 4>& node, int first, std::span<const Vec3> x) {
  const Vec3 p = x[node[0]], q = x[node[1]], r = x[node[2]], s = x[node[3]];
  if (first == 1) {
    const auto w = closestOnTriangle(p, q, r, s);
    return {{1, -w[0], -w[1], -w[2]}, false, p - (q * w[0] + r * w[1] + s * w[2])};
  }
  const auto at = closestOnSegments(p, q, r, s);
  return {{1 - at[0], at[0], at[1] - 1, -at[1]},
          at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1,
          lerp(p, q, at[0]) - lerp(r, s, at[1])};
}

// A plane across the way between the nearest nodes of two sides bounds their distance from below, for far less than
// their closest points cost. `low`, `high`: the least of the one side and the most of the other along that way.
bool fartherThan(double reach, double low, double high, double way) { return low - high > (reach + kRounding) * way; }

}  // namespace

ContactPairs::ContactPairs(const ClothTopology& topology, const SewnGroups& sewn, double radius, double spacing)
    : topology_(topology),
      list_(topology, sewn, spacing),
      radius_(radius),
      spacing_(spacing),
      candidateReach_(std::fmin(kCandidateReach * radius, radius + kCandidateCell * spacing)) {}

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

void ContactPairs::measureNormals(std::span<const Vec3> x) {
  normal_.assign(x.size(), {});
  for (const Triangle& face : topology_.faces) {
    const Vec3 n = cross(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]]);
    for (NodeIndex k : face) normal_[k] += n;
  }
  for (Vec3& n : normal_) n = normalized(n);
}

void ContactPairs::measureMotion(std::span<const Vec3> to, std::span<const Vec3> from, Motion& motion,
                                 Workers& workers) const {
  motion.way.resize(to.size());
  motion.spread.resize(to.size());
  workers.forBlocks(to.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) motion.way[k] = from.empty() ? to[k] : to[k] - from[k];
  });
  workers.forBlocks(to.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double most = 0;
      for (const std::uint32_t e : topology_.edgesOf.of(static_cast<NodeIndex>(k)))
        for (const NodeIndex other : topology_.edges[e])
          most = std::max(most, squaredLength(motion.way[other] - motion.way[k]));
      motion.spread[k] = std::sqrt(most);
    }
  });
}

// How far a plane along the sheets keeps all faces at a from all faces at b, metres; 0: not at all.
double ContactPairs::sheetsApart(NodeIndex a, NodeIndex b) const {
  const std::vector<Vec3>& x = list_.madeAt();
  const Vec3 origin = x[b], between = x[a] - origin;
  const auto farthest = [&](NodeIndex own, Vec3 way) {  // of the faces at a node, from the origin
    double most = dot(x[own] - origin, way);
    for (const std::uint32_t e : topology_.edgesOf.of(own))
      for (NodeIndex end : topology_.edges[e]) most = std::max(most, dot(x[end] - origin, way));
    return most;
  };
  const Vec3 na = normal_[a], nb = normal_[b];
  double most = 0;
  for (Vec3 n : {dot(na, nb) < 0 ? na - nb : na + nb, na, nb}) {
    if (dot(between, n) < 0) n = -n;
    const double least = most * length(n);
    if (dot(between, n) <= least) continue;
    const double high = farthest(b, n);
    if (dot(between, n) - high <= least) continue;
    const double apart = -farthest(a, -n) - high;
    if (apart > least) most = apart / length(n);
  }
  return most;
}

// Each pair is found once, from its two nearest nodes where the list was made. Neighbours find nothing; where a sharp
// fold squeezes them so that they are the nearest, the next nearest do.
template <class Use>
void ContactPairs::nodeFaces(NodeIndex a, NodeIndex b, double reach, const Use& use) const {
  const std::vector<Vec3>& x = list_.madeAt();
  const Vec3 p = x[a], between = p - x[b];
  const double toB = squaredLength(between), way = std::sqrt(toB), low = dot(p, between);
  for (const std::uint32_t f : topology_.facesOf.of(b)) {
    const Triangle& face = topology_.faces[f];
    bool mine = true;  // whether b is the nearest corner that may find the face
    double high = -1e300;
    for (NodeIndex c : face) {
      high = std::max(high, dot(x[c], between));
      if (c == b) continue;
      const double toC = squaredLength(p - x[c]);
      if ((toC < toB || (toC == toB && c < b)) && !topology_.neighbours(a, c)) mine = false;
    }
    if (!mine || fartherThan(reach, low, high, way)) continue;
    if (topology_.sewn(face[0], a) || topology_.sewn(face[1], a) || topology_.sewn(face[2], a)) continue;
    Candidate candidate{{a, face[0], face[1], face[2]}};
    for (int k = 0; k < 3; ++k)
      if (topology_.neighbours(a, face[k])) candidate.neighbours |= 1 << k;
    use(candidate);
  }
}

template <class Use>
void ContactPairs::edgeEdges(NodeIndex a, NodeIndex b, double reach, const Use& use) const {
  const std::vector<Vec3>& x = list_.madeAt();
  const Vec3 between = x[a] - x[b];
  const double both = squaredLength(between), way = std::sqrt(both);
  const auto nearer = [&](NodeIndex i, NodeIndex j, bool tie) {  // two other ends that find the pair
    const double apart = squaredLength(x[i] - x[j]);
    return (apart < both || (tie && apart == both)) && !topology_.neighbours(i, j);
  };
  for (const std::uint32_t e : topology_.edgesOf.of(a)) {
    const NodeIndex a2 = topology_.edges[e][topology_.edges[e][0] == a];
    if (nearer(a2, b, a2 < a) || topology_.sewn(a2, b)) continue;
    const double low = std::min(dot(x[a], between), dot(x[a2], between));
    for (const std::uint32_t f : topology_.edgesOf.of(b)) {
      const NodeIndex b2 = topology_.edges[f][topology_.edges[f][0] == b];
      if (nearer(a, b2, b2 < b) || topology_.sewn(a, b2)) continue;
      if (fartherThan(reach, low, std::max(dot(x[b], between), dot(x[b2], between)), way)) continue;
      if (nearer(a2, b2, false) || topology_.sewn(a2, b2)) continue;
      Candidate candidate{{a, a2, b, b2}, 2};
      if (topology_.neighbours(a, b2)) candidate.neighbours |= 2;
      if (topology_.neighbours(a2, b)) candidate.neighbours |= 4;
      if (topology_.neighbours(a2, b2)) candidate.neighbours |= 8;
      const bool sides = candidate.neighbours == kOppositeSides && topology_.isFace(a, a2, b2) &&
                         topology_.isFace(b, a2, b2);  // found by themselves
      if (!sides) use(candidate);
    }
  }
}

template <class Use>
void ContactPairs::eachOf(NodeIndex a, NodeIndex b, double reach, const Use& use) const {
  nodeFaces(a, b, reach, use);
  nodeFaces(b, a, reach, use);
  edgeEdges(a, b, reach, use);
}

void ContactPairs::makeCandidates(std::span<const Vec3> x, Workers& workers) {
  measureNormals(x);
  const auto& list = list_.pairs();
  clear_.assign(list.size(), 0);
  start_.assign(list.size() + 1, 0);
  std::vector<std::vector<Candidate>> found((list.size() + kPairBlock - 1) / kPairBlock);
  workers.forBlocks(list.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = found[begin / kPairBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto [a, b] = list[n];
      clear_[n] = length(x[a] - x[b]) - kEdgeReach * std::fmax(longestEdge_[a], longestEdge_[b]);
      if (clear_[n] < candidateReach_) clear_[n] = std::fmax(clear_[n], sheetsApart(a, b));
      if (clear_[n] >= candidateReach_) continue;
      const std::size_t before = out.size();
      clear_[n] = candidateReach_;
      eachOf(a, b, candidateReach_, [&](Candidate& candidate) {
        candidate.gap = length(closestOf(candidate.node, candidate.first, x).way);
        if (candidate.gap >= candidateReach_) return;
        clear_[n] = std::fmin(clear_[n], candidate.gap);
        out.push_back(candidate);
      });
      start_[n + 1] = static_cast<std::uint32_t>(out.size() - before);
    }
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  candidates_.clear();
  for (const auto& block : found) candidates_.insert(candidates_.end(), block.begin(), block.end());
}

// In a crumple cells collapse until opposite sides come as near as cloth may. Joined at either end, they have only
// their far corners to find each other by, which may be twice as far apart as they are long. All their ends are on an
// edge of one node, m: none moves against another by more than twice as much as those edges' ends do at most.
void ContactPairs::measureSides(std::span<const Vec3> x, Workers& workers) {
  if (sidesClear_.empty())
    sidesClear_.assign(x.size(), 0);
  else
    measureMotion(x, list_.madeAt(), drift_, workers);
  workers.forBlocks(x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      double& clear = sidesClear_[m];
      if (!drift_.spread.empty()) clear -= 2 * drift_.spread[m] + kRounding;
      if (clear > candidateReach_) continue;
      clear = kFarApart;
      for (std::uint32_t k = topology_.sidesOf[m]; k < topology_.sidesOf[m + 1]; ++k)
        clear = std::fmin(clear, length(closestOf(topology_.oppositeSides[k], 2, x).way));
    }
  });
}

// Whether neighbours among the nodes of its two sides are nearer to each other than any others: in a sharp fold.
bool ContactPairs::squeezed(const Candidate& candidate, std::span<const Vec3> x) const {
  if (!candidate.neighbours) return false;
  double neighbours = 1e300, others = 1e300;
  int bit = 0;
  for (int i = 0; i < candidate.first; ++i)
    for (int j = candidate.first; j < 4; ++j, ++bit) {
      double& least = candidate.neighbours >> bit & 1 ? neighbours : others;
      least = std::fmin(least, squaredLength(x[candidate.node[i]] - x[candidate.node[j]]));
    }
  return neighbours < others;
}

bool ContactPairs::nearOnPaper(const ContactPair& pair) const {
  Flat apart;
  for (int k = 0; k < 4; ++k) apart = apart + topology_.paper[pair.node[k]] * pair.weight[k];
  return topology_.piece[pair.node[0]] != topology_.piece[pair.node[3]] || length(apart) < kPaperNear * radius_;
}

void ContactPairs::measure(const Candidate& candidate, const Search& search, std::vector<ContactPair>& out) const {
  const auto& node = candidate.node;
  double apart = 0;
  if (!search.move.empty())
    for (int i = 0; i < candidate.first; ++i)
      for (int j = candidate.first; j < 4; ++j)
        apart = std::max(apart, squaredLength(search.move[node[i]] - search.move[node[j]]));
  const Closest closest = closestOf(node, candidate.first, search.x);
  // At an edge's end the node-face pair answers.
  if (search.move.empty() && closest.atEnd) return;
  const double gap = length(closest.way);
  if (!(gap < search.within + kMoveReach * std::sqrt(apart) && gap > kLeastGap)) return;
  const ContactPair pair{node, closest.weight, candidate.first, closest.way * (1 / gap), gap};
  // What a sharp fold squeezes together and what lies near on paper is not pushed apart.
  if (search.move.empty() && squeezed(candidate, search.x) && nearOnPaper(pair)) return;
  out.push_back(pair);
}

std::vector<ContactPair> ContactPairs::find(const Search& search, Workers& workers) {
  const ApproachBound::Motion motion{search.x, search.move, kMoveReach};
  const auto listed = [&] { return search.within + kEdgeReach * longest_; };
  if (kWornShare * worn_ > list_.pairs().size() || !list_.covers(motion, listed())) {
    measureEdges(search.x);
    measureSides(search.x, workers);
    list_.make(motion, listed(), workers);
    makeCandidates(search.x, workers);
    worn_ = 0;
  }
  const bool moves = !search.move.empty();
  measureMotion(search.x, list_.madeAt(), drift_, workers);
  if (moves) measureMotion(search.move, {}, ahead_, workers);
  // By how much what is incident to a node went at most: most pairs are passed over by these two alone.
  bound_.resize(search.x.size());
  workers.forBlocks(search.x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      bound_[k] = drift_.most(k) + (moves ? kMoveReach * ahead_.most(k) : 0) + kRounding;
  });
  const auto& list = list_.pairs();
  struct Found {
    std::vector<ContactPair> pairs;
    std::size_t worn = 0;
  };
  const std::vector<Found> found = workers.each(list.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
    Found block;
    for (std::size_t n = begin; n < end; ++n) {
      const auto [a, b] = list[n];
      if (clear_[n] > search.within + bound_[a] + bound_[b]) continue;
      const double reach =
          search.within + drift_.between(a, b) + (moves ? kMoveReach * ahead_.between(a, b) : 0) + kRounding;
      if (clear_[n] > reach) continue;
      if (!leftOut_.empty() && leftOut_[a] && leftOut_[b]) continue;
      if (reach > candidateReach_) {
        ++block.worn;
        eachOf(a, b, reach, [&](const Candidate& candidate) { measure(candidate, search, block.pairs); });
        continue;
      }
      for (std::uint32_t c = start_[n]; c < start_[n + 1]; ++c)
        if (candidates_[c].gap <= reach) measure(candidates_[c], search, block.pairs);
    }
    return block;
  });
  const auto sides = workers.each(search.x.size(), kPairBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<ContactPair> near;
    for (std::size_t m = begin; m < end; ++m) {
      const double spread = drift_.spread[m] + (moves ? kMoveReach * ahead_.spread[m] : 0);
      if (sidesClear_[m] > search.within + 2 * spread + kRounding) continue;
      for (std::uint32_t k = topology_.sidesOf[m]; k < topology_.sidesOf[m + 1]; ++k) {
        const Candidate candidate{topology_.oppositeSides[k], 2, kOppositeSides};
        const bool out = !leftOut_.empty() && leftOut_[candidate.node[0]] && leftOut_[candidate.node[2]];
        if (!out) measure(candidate, search, near);
      }
    }
    return near;
  });
  std::vector<ContactPair> all;
  for (const Found& block : found) {
    all.insert(all.end(), block.pairs.begin(), block.pairs.end());
    worn_ += block.worn;
  }
  for (const auto& block : sides) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace karinui
