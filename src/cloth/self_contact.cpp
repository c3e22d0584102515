#include "cloth/self_contact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cloth/body_contact.h"
#include "cloth/lattice_shares.h"
#include "cloth/nearest.h"

namespace karinui {
namespace {

constexpr double kFirmness = 3e5;    // N/m per m2 of cloth, as against the body
constexpr double kAside = 1.1;       // radii within which a pair that held keeps its anchor
constexpr double kNews = 0.2;        // how much a step's push counts in that of late
constexpr double kForgotten = 1e-8;  // metres: an anchor that holds no further is none
constexpr double kReach = 0.75;      // in longest edges: how far a pair's nearest corners can lie apart
constexpr double kFlat = 1.5;        // radii: nearer than this on paper, what a fold squeezes does not push
constexpr double kNarrow = 3;        // radii: nearer than this on paper, corners across an edge do not meet
constexpr double kRoom = 0.7;        // in spacings: how much further it is looked around than is asked for
constexpr double kOpen = -0.5;       // a seam opened wider is not asked whether its sheets pass through each other
constexpr std::size_t kMostCells = 400'000;
constexpr std::size_t kBlock = 128;

void startsOf(std::size_t count, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& items,
              std::vector<std::uint32_t>& start, std::vector<std::uint32_t>& item) {
  start.assign(count + 1, 0);
  item.resize(items.size());
  for (const auto& [key, value] : items) ++start[key + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (const auto& [key, value] : items) item[fill[key]++] = value;
}

bool beside(const std::vector<std::uint32_t>& start, const std::vector<std::uint32_t>& item, NodeIndex a, NodeIndex b) {
  return std::binary_search(item.begin() + start[a], item.begin() + start[a + 1], b);
}

}  // namespace

// Nodes sorted into cells of a box around the cloth.
struct SelfContact::Grid {
  Vec3 low;
  double cell = 1;
  std::array<std::int64_t, 3> count{};
  std::vector<std::uint32_t> start, item;
  std::vector<Vec3> place;  // of each item

  std::array<std::int64_t, 3> at(Vec3 p) const {
    return {static_cast<std::int64_t>((p.x - low.x) / cell), static_cast<std::int64_t>((p.y - low.y) / cell),
            static_cast<std::int64_t>((p.z - low.z) / cell)};
  }
  std::size_t number(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * count[1] + j) * count[0] + i);
  }
  Grid(std::span<const Vec3> x, double reach) : low(x.front()), cell(reach) {
    Vec3 high = low;
    for (Vec3 p : x) {
      low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
      high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    for (;; cell *= 1.3) {
      const auto last = at(high);
      count = {last[0] + 1, last[1] + 1, last[2] + 1};
      const double cells =
          static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]);
      if (cells <= static_cast<double>(kMostCells)) break;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> items;
    items.reserve(x.size());
    for (std::uint32_t n = 0; n < x.size(); ++n) {
      const auto c = at(x[n]);
      items.emplace_back(static_cast<std::uint32_t>(number(c[0], c[1], c[2])), n);
    }
    startsOf(static_cast<std::size_t>(count[0] * count[1] * count[2]), items, start, item);
    for (const std::uint32_t n : item) place.push_back(x[n]);
  }
};

SelfContact::SelfContact(const Cloth& cloth, double radius)
    : radius_(radius), firmness_(kFirmness * cloth.spacing * cloth.spacing), spacing_(cloth.spacing) {
  friction_.assign(cloth.nodeCount, 0);
  live_.assign(cloth.nodeCount, 0);
  partner_.resize(cloth.nodeCount);
  std::iota(partner_.begin(), partner_.end(), 0);
  const auto root = [&](std::uint32_t k) {
    while (partner_[k] != k) k = partner_[k] = partner_[partner_[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    partner_[root(tie.b)] = root(tie.a);
    if (tie.c != kNoNode) partner_[root(tie.c)] = root(tie.a);
  }
  for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) partner_[k] = root(k);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> memberOf;
  for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) memberOf.emplace_back(partner_[k], k);
  std::vector<std::uint32_t> memberStart, member;  // the nodes of each partner number
  startsOf(cloth.nodeCount, memberOf, memberStart, member);
  const auto partners = [&](NodeIndex k) {
    return std::span<const NodeIndex>(member).subspan(memberStart[partner_[k]],
                                                      memberStart[partner_[k] + 1] - memberStart[partner_[k]]);
  };

  std::vector<std::pair<std::uint32_t, std::uint32_t>> byNode, nears, over;
  std::vector<std::pair<std::array<NodeIndex, 2>, NodeIndex>> sides;  // edge and the corner opposite
  for (const ClothPiece& piece : cloth.pieces) {
    piece_.insert(piece_.end(), piece.lattice->nodes.size(), static_cast<std::uint32_t>(&piece - cloth.pieces.data()));
    flat_.insert(flat_.end(), piece.lattice->nodes.begin(), piece.lattice->nodes.end());
    for (std::uint32_t k = 0; k < piece.lattice->nodes.size(); ++k) {
      friction_[piece.firstNode + k] = piece.fabric.frictionCloth;
      live_[piece.firstNode + k] = piece.live ? 1 : 0;
    }
    for (const Triangle& f : piece.lattice->faces) {
      const Triangle face{piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]};
      for (int c = 0; c < 3; ++c) {
        byNode.emplace_back(face[c], static_cast<std::uint32_t>(faces_.size()));
        const auto [low, high] = std::minmax(face[c], face[(c + 1) % 3]);
        sides.push_back({{low, high}, face[(c + 2) % 3]});
      }
      faces_.push_back(face);
    }
  }
  startsOf(cloth.nodeCount, byNode, faceStart_, faceItem_);
  std::sort(sides.begin(), sides.end());
  byNode.clear();
  // Over a seam a node meets what lies beside its partners, or sheets that part at the seam would pass through each
  // other there; but not where that is so narrow that they always would.
  const auto near = [&](NodeIndex a, NodeIndex b) {
    const bool narrow = distance(flat_[a], flat_[b]) < kNarrow * radius;
    for (const NodeIndex i : partners(a))
      for (const NodeIndex j : partners(b)) {
        auto& to = narrow || (i == a && j == b) ? nears : over;
        to.emplace_back(i, j);
        to.emplace_back(j, i);
      }
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& [edge, opposite] = sides[s];
    if (s > 0 && sides[s - 1].first == edge) {
      // Corners across an edge lie a fold apart and must meet, but in a ring so narrow that they always would.
      const NodeIndex other = sides[s - 1].second;
      if (distance(flat_[other], flat_[opposite]) < kNarrow * radius) near(other, opposite);
      continue;
    }
    near(edge[0], edge[1]);
    for (NodeIndex k : edge) byNode.emplace_back(k, static_cast<std::uint32_t>(edges_.size()));
    edges_.push_back(edge);
  }
  startsOf(cloth.nodeCount, byNode, edgeStart_, edgeItem_);
  for (auto* pairs : {&nears, &over}) {
    std::sort(pairs->begin(), pairs->end());
    pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
  }
  startsOf(cloth.nodeCount, nears, nearStart_, nearItem_);
  startsOf(cloth.nodeCount, over, overStart_, overItem_);
}

void SelfContact::setTies(const TieMap& ties) {
  together_.clear();
  togetherOf_.assign(partner_.size(), kNoNode);
  held_.assign(partner_.size(), 0);
  for (NodeIndex k = 0; k < partner_.size(); ++k) held_[k] = ties.parts(k).empty() ? 1 : 0;
  for (const auto& members : ties.groups()) {
    if (members.size() < 2) continue;
    for (NodeIndex k : members) togetherOf_[k] = static_cast<std::uint32_t>(together_.size());
    together_.push_back(members);
  }
}

bool SelfContact::neighbours(NodeIndex a, NodeIndex b) const {
  return partner_[a] == partner_[b] || beside(nearStart_, nearItem_, a, b);
}

// The cosine by which the sheets at two nodes beside each other over a seam stand apart: -1 where they lie open.
double SelfContact::folded(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const {
  const auto into = [&](NodeIndex k, NodeIndex other) {  // from the seam into the sheet
    if (togetherOf_[k] == kNoNode) return x[k] - x[other];
    Vec3 sum;
    for (std::uint32_t f = faceStart_[k]; f < faceStart_[k + 1]; ++f)
      for (const NodeIndex c : faces_[faceItem_[f]]) sum += x[c] - x[k];
    return sum;
  };
  return dot(normalized(into(a, b)), normalized(into(b, a)));
}

double SelfContact::measureEdges(std::span<const Vec3> x) {
  // One torn edge must not make every pair near: such a place is coarse anyway.
  const double most = 9 * spacing_ * spacing_;
  double longest = 0;
  longest_.assign(x.size(), 0);
  for (const auto& [a, b] : edges_) {
    const double own = squaredLength(x[b] - x[a]), length = own < most ? own : most;  // what is no number: the most
    longest_[a] = std::max(longest_[a], length);
    longest_[b] = std::max(longest_[b], length);
    longest = std::max(longest, length);
  }
  for (double& length : longest_) length = std::sqrt(length);
  return std::sqrt(longest);
}

// Each pair is asked about by its two nearest nodes. Neighbours do not ask; where cloth is squeezed in a sharp fold
// they may yet be the nearest, and the next nearest ask instead. Then what lies so near on paper, too, does not push.
bool SelfContact::asks(NodeIndex a, NodeIndex b, bool& squeezed) const {
  if (!neighbours(a, b)) return true;
  squeezed = true;
  return false;
}

bool SelfContact::nearOnPaper(const Pair& pair) const {
  Flat apart;
  for (int k = 0; k < 4; ++k) apart = apart + flat_[pair.node[k]] * pair.weight[k];
  return piece_[pair.node[0]] != piece_[pair.node[3]] || length(apart) < kFlat * radius_;
}

void SelfContact::nodeFaces(NodeIndex a, NodeIndex b, const Ask& ask, std::vector<Pair>& out) const {
  const Vec3 p = ask.x[a];
  const double toB = squaredLength(p - ask.x[b]);
  for (std::uint32_t k = faceStart_[b]; k < faceStart_[b + 1]; ++k) {
    const Triangle& face = faces_[faceItem_[k]];
    bool mine = true, squeezed = false;  // each face is asked about from its nearest corner
    double apart = 0;
    for (NodeIndex c : face) {
      const double toC = squaredLength(p - ask.x[c]);
      if (partner_[c] == partner_[a] || (c != b && (toC < toB || (toC == toB && c < b)) && asks(a, c, squeezed)))
        mine = false;
      if (!ask.move.empty()) apart = std::fmax(apart, squaredLength(ask.move[a] - ask.move[c]));
    }
    if (!mine) continue;
    const auto w = nearestOnTriangle(p, ask.x[face[0]], ask.x[face[1]], ask.x[face[2]]);
    const Vec3 d = p - (ask.x[face[0]] * w[0] + ask.x[face[1]] * w[1] + ask.x[face[2]] * w[2]);
    const double gap = length(d);
    if (!(gap < ask.within + 1.2 * std::sqrt(apart) && gap > 1e-9)) continue;
    const Pair pair{{a, face[0], face[1], face[2]}, {1, -w[0], -w[1], -w[2]}, 1, d * (1 / gap), gap};
    if (!(squeezed && ask.move.empty() && nearOnPaper(pair))) out.push_back(pair);
  }
}

void SelfContact::edgeEdges(NodeIndex a, NodeIndex b, const Ask& ask, std::vector<Pair>& out) const {
  const Vec3 pa = ask.x[a], pb = ask.x[b];
  const double both = squaredLength(pa - pb);
  const auto other = [&](std::uint32_t e, NodeIndex k) { return edges_[e][0] == k ? edges_[e][1] : edges_[e][0]; };
  for (std::uint32_t i = edgeStart_[a]; i < edgeStart_[a + 1]; ++i) {
    const NodeIndex a2 = other(edgeItem_[i], a);
    const Vec3 pa2 = ask.x[a2];
    const double cross1 = squaredLength(pa2 - pb);
    if (partner_[a2] == partner_[b]) continue;
    bool squeezed1 = false;
    if ((cross1 < both || (cross1 == both && a2 < a)) && asks(a2, b, squeezed1)) continue;
    for (std::uint32_t j = edgeStart_[b]; j < edgeStart_[b + 1]; ++j) {
      const NodeIndex b2 = other(edgeItem_[j], b);
      if (partner_[a2] == partner_[b2] || partner_[b2] == partner_[a]) continue;
      const Vec3 pb2 = ask.x[b2];
      const double cross2 = squaredLength(pb2 - pa);
      bool squeezed = squeezed1;
      if ((cross2 < both || (cross2 == both && b2 < b)) && asks(a, b2, squeezed)) continue;
      if (squaredLength(pa2 - pb2) < both && asks(a2, b2, squeezed)) continue;
      const auto at = nearestOnSegments(pa, pa2, pb, pb2);
      if (ask.move.empty() && (at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1)) continue;  // a node speaks there
      const Vec3 d = lerp(pa, pa2, at[0]) - lerp(pb, pb2, at[1]);
      double apart = 0;
      if (!ask.move.empty())
        for (NodeIndex m : {a, a2})
          for (NodeIndex n : {b, b2}) apart = std::fmax(apart, squaredLength(ask.move[m] - ask.move[n]));
      const double gap = length(d);
      if (!(gap < ask.within + 1.2 * std::sqrt(apart) && gap > 1e-9)) continue;
      const Pair pair{{a, a2, b, b2}, {1 - at[0], at[0], at[1] - 1, -at[1]}, 2, d * (1 / gap), gap};
      if (!(squeezed && ask.move.empty() && nearOnPaper(pair))) out.push_back(pair);
    }
  }
}

void SelfContact::lookAround(std::span<const Vec3> x, double reach, Workers& workers) {
  double moved = 0;
  if (nearAt_.size() == x.size())
    for (std::size_t k = 0; k < x.size(); ++k) moved = std::fmax(moved, squaredLength(x[k] - nearAt_[k]));
  if (nearAt_.size() == x.size() && reach + 2 * std::sqrt(moved) <= nearReach_) return;
  nearReach_ = reach + kRoom * spacing_;
  nearAt_.assign(x.begin(), x.end());
  const Grid grid(x, nearReach_);
  std::vector<std::vector<std::array<NodeIndex, 2>>> parts((x.size() + kBlock - 1) / kBlock);
  workers.forBlocks(x.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = parts[begin / kBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto a = static_cast<NodeIndex>(n);
      const Vec3 p = x[a];
      const auto c = grid.at(p);
      for (std::int64_t k = std::max<std::int64_t>(0, c[2] - 1); k <= std::min(grid.count[2] - 1, c[2] + 1); ++k)
        for (std::int64_t j = std::max<std::int64_t>(0, c[1] - 1); j <= std::min(grid.count[1] - 1, c[1] + 1); ++j) {
          // Cells beside each other along x lie beside each other in memory.
          const std::size_t from = grid.number(std::max<std::int64_t>(0, c[0] - 1), j, k);
          const std::size_t to = grid.number(std::min(grid.count[0] - 1, c[0] + 1), j, k);
          for (std::uint32_t i = grid.start[from]; i < grid.start[to + 1]; ++i) {
            const NodeIndex b = grid.item[i];
            if (b <= a || (!live_[a] && !live_[b])) continue;
            if (squaredLength(grid.place[i] - p) > nearReach_ * nearReach_ || neighbours(a, b)) continue;
            if (overStart_[a] < overStart_[a + 1] && beside(overStart_, overItem_, a, b) && folded(a, b, x) < kOpen)
              continue;
            out.push_back({a, b});
          }
        }
    }
  });
  near_.clear();
  for (const auto& part : parts) near_.insert(near_.end(), part.begin(), part.end());
}

std::vector<SelfContact::Pair> SelfContact::collect(const Ask& ask, Workers& workers) {
  double most = 0;
  for (Vec3 m : ask.move) most = std::fmax(most, squaredLength(m));
  const double still = ask.within + kReach * ask.longest;
  const double reach = still + 2.4 * std::sqrt(most);
  lookAround(ask.x, reach, workers);
  std::vector<std::vector<Pair>> parts((near_.size() + kBlock - 1) / kBlock);
  workers.forBlocks(near_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    auto& out = parts[begin / kBlock];
    for (std::size_t n = begin; n < end; ++n) {
      const auto [a, b] = near_[n];
      const double d2 = squaredLength(ask.x[b] - ask.x[a]);
      if (d2 > reach * reach) continue;
      double far = ask.within + kReach * std::fmax(longest_[a], longest_[b]);
      // The nodes of a pair move nearly alike, so what these two do stands for it, with room to spare.
      if (!ask.move.empty()) far += 0.25 * spacing_ + 1.5 * length(ask.move[a] - ask.move[b]);
      if (d2 > far * far) continue;
      if (!leftOut_.empty() && leftOut_[a] && leftOut_[b]) continue;
      nodeFaces(a, b, ask, out);
      nodeFaces(b, a, ask, out);
      edgeEdges(a, b, ask, out);
    }
  });
  std::vector<Pair> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void SelfContact::find(std::span<const Vec3> x, Workers& workers, bool sliding) {
  found_.clear();
  hold_.clear();
  if (radius_ <= 0 || !on_) return;
  found_ = collect({x, {}, kAside * radius_, measureEdges(x)}, workers);
  for (Pair& pair : found_) {
    pair.push = std::fmax(0.0, firmness_ * (radius_ - pair.gap));
    hold_.push_back(holdOn(pair, x));
    if (sliding && hold_.back().anchor.slip > kSlides) pair.across = 0;
  }
}

Vec3 SelfContact::pullOf(const Pair& pair, const Anchor& anchor, std::span<const Vec3> x) {
  Vec3 pull = anchor.offset;
  for (int k = 0; k < 4; ++k) pull += x[pair.node[k]] * anchor.weight[k];
  return pull - pair.normal * dot(pull, pair.normal);
}

SelfContact::Hold SelfContact::holdOn(Pair& pair, std::span<const Vec3> x) const {
  Hold hold;
  const auto at = std::lower_bound(stuck_.begin(), stuck_.end(), pair.node,
                                   [](const Stuck& s, const std::array<NodeIndex, 4>& n) { return s.node < n; });
  if (at == stuck_.end() || at->node != pair.node) {
    hold.anchor.weight = pair.weight;
    hold.anchor.push = pair.push;
    pair.across = pair.push > 0 && frictionOf(pair) > 0 ? firmness_ : 0;
    return hold;
  }
  hold.anchor = at->anchor;
  hold.anchor.push = std::lerp(at->anchor.push, pair.push, kNews);
  const double most = frictionOf(pair) * hold.anchor.push;
  if (most <= 0) return hold;
  const Vec3 pull = pullOf(pair, hold.anchor, x);
  const double length = karinui::length(pull), slip = hold.anchor.slip;
  const double spring = length > 0 ? std::fmin(firmness_, most / length) : firmness_;
  pair.across = slip > 0 ? std::fmin(spring, most / (length + slip)) : spring;
  hold.force = pull * spring;
  if (slip > 0 && length > 0) hold.ahead = pull * (pair.across * slip / length);
  return hold;
}

void SelfContact::moveAnchors(std::span<const Vec3> x) {
  std::vector<Stuck> kept;
  for (std::size_t p = 0; p < found_.size(); ++p) {
    const Pair& pair = found_[p];
    Vec3 apart;
    for (int k = 0; k < 4; ++k) apart += x[pair.node[k]] * pair.weight[k];
    Anchor anchor = hold_[p].anchor;
    const double gap = dot(apart, pair.normal);
    const double most = frictionOf(pair) * anchor.push / firmness_;  // metres the spring stretches
    if (most <= kForgotten) continue;
    const Vec3 pull = pullOf(pair, anchor, x);
    const double length = karinui::length(pull);
    anchor.slip = std::fmax(0.0, length - most);
    if (anchor.slip > 0) {
      anchor.weight = pair.weight;
      anchor.offset = pull * (most / length) - (apart - pair.normal * gap);
    }
    kept.push_back({pair.node, anchor});
  }
  std::sort(kept.begin(), kept.end(), [](const Stuck& a, const Stuck& b) { return a.node < b.node; });
  stuck_ = std::move(kept);
}

void SelfContact::addGradient(std::span<Vec3> gradient) const {
  for (std::size_t p = 0; p < found_.size(); ++p)
    for (int k = 0; k < 4; ++k)
      gradient[found_[p].node[k]] += (hold_[p].force - found_[p].normal * found_[p].push) * found_[p].weight[k];
}

void SelfContact::addExpectedSlip(std::span<Vec3> force) const {
  for (std::size_t p = 0; p < found_.size(); ++p)
    for (int k = 0; k < 4; ++k) force[found_[p].node[k]] += hold_[p].ahead * found_[p].weight[k];
}

void SelfContact::addCouplings(const TieMap& ties, std::vector<Coupling>& couplings) const {
  for (const Pair& pair : found_)
    if (pair.push > 0 || pair.across > 0)
      couplings.push_back(
          {partsOf(ties, pair.node, pair.weight), pair.normal, pair.push > 0 ? firmness_ : 0, pair.across});
}

bool SelfContact::guard(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) {
  bool cut = false;
  if (radius_ <= 0 || !on_) return cut;
  const double longest = measureEdges(x);
  for (int pass = 0; pass < 3; ++pass) {  // again where what was cut may meet something new
    if (!guardOnce({x, move, 0.15 * radius_, longest}, move, workers)) break;
    cut = true;
  }
  return cut;
}

bool SelfContact::guardOnce(const Ask& ask, std::vector<Vec3>& move, Workers& workers) {
  const std::span<const Vec3> x = ask.x;
  const std::vector<Pair> pairs = collect(ask, workers);
  const auto set = [&](NodeIndex k, Vec3 m) {
    if (held_[k]) return;
    if (togetherOf_[k] == kNoNode)
      move[k] = m;
    else
      for (NodeIndex other : together_[togetherOf_[k]]) move[other] = m;
  };
  bool any = false;
  for (int round = 0; round < 40; ++round) {
    bool bad = false;
    for (const Pair& pair : pairs) {
      // Lowest of the first side, highest of the second, along the normal: as they stand and as they would.
      double low = 1e300, high = -1e300, lowNow = 1e300, highNow = -1e300;
      for (int k = 0; k < 4; ++k) {
        const double now = dot(x[pair.node[k]], pair.normal), s = now + dot(move[pair.node[k]], pair.normal);
        if (k < pair.first) {
          low = std::fmin(low, s);
          lowNow = std::fmin(lowNow, now);
        } else {
          high = std::fmax(high, s);
          highNow = std::fmax(highNow, now);
        }
      }
      // Where the nearest places are on rims no plane parts the whole of both sides; they must not come to lie deeper
      // than they do, but asked for more they could never move again.
      const double least = std::fmin(std::fmin(0.25 * pair.gap, 0.05 * radius_), lowNow - highNow);
      if (low - high >= least - 1e-3 * std::fabs(least)) continue;
      bad = any = true;
      if (round < 12) {  // both sides to the middle plane
        const double middle = 0.5 * (low + high);
        for (int k = 0; k < 4; ++k) {
          const NodeIndex node = pair.node[k];
          const double s = dot(x[node] + move[node], pair.normal);
          if (k < pair.first && s < middle + 0.5 * least)
            set(node, move[node] + pair.normal * (middle + 0.5 * least - s));
          else if (k >= pair.first && s > middle - 0.5 * least)
            set(node, move[node] - pair.normal * (s - middle + 0.5 * least));
        }
      } else {
        for (NodeIndex node : pair.node) set(node, move[node] * (round < 30 ? 0.5 : 0.0));
      }
    }
    if (!bad) break;
  }
  return any;
}

}  // namespace karinui
