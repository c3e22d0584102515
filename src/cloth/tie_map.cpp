#include "cloth/tie_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace karinui {
namespace {

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

using Row = std::map<std::uint32_t, double>;  // group -> weight; ordered, so results do not depend on addresses

void addScaled(Row& row, const Row& other, double s) {
  for (const auto& [group, weight] : other) {
    double& w = row[group];
    w += s * weight;
    if (std::fabs(w) < 1e-12) row.erase(group);
  }
}

}  // namespace

TieMap::TieMap(const Cloth& cloth, const std::vector<std::uint8_t>& held, const std::vector<std::uint8_t>& tied)
    : nodeHeld_(held) {
  const std::uint32_t count = cloth.nodeCount;
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    const Tie& tie = cloth.ties[t];
    if (!tied[t] || (tie.c != kNoNode && tie.c != tie.b)) continue;
    const std::uint32_t a = rootOf(parent, tie.a), b = rootOf(parent, tie.b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
  group_.assign(count, 0);
  std::vector<std::uint32_t> groupOfRoot(count, kNoNode);
  for (std::uint32_t k = 0; k < count; ++k) {
    std::uint32_t& group = groupOfRoot[rootOf(parent, k)];
    if (group == kNoNode) {
      group = static_cast<std::uint32_t>(members_.size());
      members_.emplace_back();
      groupHeld_.push_back(0);
    }
    group_[k] = group;
    members_[group].push_back(k);
    if (held[k]) groupHeld_[group] = 1;
  }

  // Pairs sewn 2:1: a = (b + c)/2 between groups, eliminated one after the other. Each makes one free group dependent
  // on others: the one with the largest weight (the pivot).
  std::map<std::uint32_t, Row> dependence;
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    const Tie& tie = cloth.ties[t];
    if (!tied[t] || tie.c == kNoNode || tie.c == tie.b) continue;
    Row raw, row;  // sum of weights x group = 0
    addScaled(raw, {{group_[tie.a], 1.0}}, 1);
    addScaled(raw, {{group_[tie.b], 1.0}}, -0.5);
    addScaled(raw, {{group_[tie.c], 1.0}}, -0.5);
    for (const auto& [group, weight] : raw) {
      const auto known = dependence.find(group);
      addScaled(row, known == dependence.end() ? Row{{group, 1.0}} : known->second, weight);
    }
    std::uint32_t pivot = kNoNode;
    double largest = 1e-9;
    for (const auto& [group, weight] : row)
      if (!groupHeld_[group] && std::fabs(weight) > largest + 1e-12) {
        largest = std::fabs(weight);
        pivot = group;
      }
    if (pivot == kNoNode) continue;  // all held already
    const double scale = -1 / row.at(pivot);
    row.erase(pivot);
    Row given;
    addScaled(given, row, scale);
    for (auto& [other, mix] : dependence)
      if (const auto uses = mix.find(pivot); uses != mix.end()) {
        const double weight = uses->second;
        mix.erase(uses);
        addScaled(mix, given, weight);
      }
    dependence.emplace(pivot, std::move(given));
  }
  for (const auto& [group, row] : dependence) {
    std::vector<Mix> mix;
    for (const auto& [other, weight] : row) mix.push_back({other, weight});
    dependent_.emplace_back(group, std::move(mix));
  }

  for (std::uint32_t g = 0; g < members_.size(); ++g)
    if (members_[g].size() > 1 && !dependence.contains(g)) sewnGroups_.push_back(g);

  std::vector<std::uint32_t> unknownOf(members_.size(), kNoNode);
  for (std::uint32_t g = 0; g < members_.size(); ++g)
    if (!groupHeld_[g] && !dependence.contains(g)) unknownOf[g] = static_cast<std::uint32_t>(unknowns_++);
  start_.assign(1, 0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t g = group_[k];
    if (const auto row = dependence.find(g); row != dependence.end()) {
      for (const auto& [other, weight] : row->second)
        if (unknownOf[other] != kNoNode) term_.push_back({unknownOf[other], weight});
    } else if (unknownOf[g] != kNoNode) {
      term_.push_back({unknownOf[g], 1});
    }
    start_.push_back(static_cast<std::uint32_t>(term_.size()));
  }
}

Vec3 TieMap::middleOf(std::uint32_t group, std::span<const Vec3> position) const {
  Vec3 sum, fixed;
  double fixedCount = 0;
  for (std::uint32_t k : members_[group]) {
    sum += position[k];
    if (nodeHeld_[k]) {
      fixed += position[k];
      fixedCount += 1;
    }
  }
  return fixedCount > 0 ? fixed * (1 / fixedCount) : sum * (1.0 / static_cast<double>(members_[group].size()));
}

void TieMap::enforce(std::vector<Vec3>& position) const {
  std::vector<Vec3> placed;
  for (const auto& [group, mix] : dependent_) {
    Vec3 place;
    for (const Mix& m : mix) place += middleOf(m.group, position) * m.weight;
    placed.push_back(place);
  }
  const auto bring = [&](std::uint32_t group, Vec3 place) {
    for (std::uint32_t k : members_[group])
      if (!nodeHeld_[k]) position[k] = place;
  };
  for (std::uint32_t group : sewnGroups_) bring(group, middleOf(group, position));
  for (std::size_t f = 0; f < dependent_.size(); ++f) bring(dependent_[f].first, placed[f]);
}

void TieMap::reduce(std::span<const Vec3> node, std::vector<Vec3>& unknown) const {
  unknown.assign(unknowns_, {});
  for (std::uint32_t k = 0; k < group_.size(); ++k)
    for (const Term& term : terms(k)) unknown[term.unknown] += node[k] * term.weight;
}

void TieMap::expand(std::span<const Vec3> unknown, std::vector<Vec3>& node) const {
  node.assign(group_.size(), {});
  for (std::uint32_t k = 0; k < group_.size(); ++k)
    for (const Term& term : terms(k)) node[k] += unknown[term.unknown] * term.weight;
}

void TieMap::makeAdmissible(std::vector<Vec3>& move) const {
  std::vector<Vec3> unknown;
  reduce(move, unknown);
  std::vector<double> weight(unknowns_, 0);
  for (const Term& term : term_) weight[term.unknown] += term.weight * term.weight;
  for (std::size_t u = 0; u < unknowns_; ++u)
    if (weight[u] > 0) unknown[u] = unknown[u] * (1 / weight[u]);
  expand(unknown, move);
}

std::vector<TieMap::Term> termsOf(const TieMap& ties, std::span<const std::uint32_t> nodes,
                                  std::span<const double> weights) {
  std::vector<TieMap::Term> terms;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (const TieMap::Term& term : ties.terms(nodes[k])) {
      bool found = false;
      for (TieMap::Term& have : terms)
        if (have.unknown == term.unknown) {
          have.weight += term.weight * weights[k];
          found = true;
        }
      if (!found) terms.push_back({term.unknown, term.weight * weights[k]});
    }
  return terms;
}

Vec3 gapOf(const Tie& tie, std::span<const Vec3> position) {
  const Vec3 other = tie.c == kNoNode ? position[tie.b] : (position[tie.b] + position[tie.c]) * 0.5;
  return other - position[tie.a];
}

std::vector<double> liveGaps(const Cloth& cloth, std::span<const Vec3> position) {
  std::vector<std::uint8_t> live(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live) std::fill_n(live.begin() + piece.firstNode, piece.lattice->nodes.size(), 1);
  std::vector<double> gaps;
  for (const Tie& tie : cloth.ties)
    if (live[tie.a] || live[tie.b] || (tie.c != kNoNode && live[tie.c])) gaps.push_back(length(gapOf(tie, position)));
  return gaps;
}

const ClothPiece& pieceOf(const Cloth& cloth, std::uint32_t node) {
  return *std::prev(std::upper_bound(cloth.pieces.begin(), cloth.pieces.end(), node,
                                     [](std::uint32_t n, const ClothPiece& piece) { return n < piece.firstNode; }));
}

double widestGap(const Cloth& cloth, std::span<const Vec3> position) {
  const std::vector<double> gaps = liveGaps(cloth, position);
  return gaps.empty() ? 0 : *std::max_element(gaps.begin(), gaps.end());
}

}  // namespace karinui
