#include "cloth/cloth_topology.h"

#include <numeric>
#include <tuple>

#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

constexpr double kNarrow = 3;  // radii: nearer than this on paper, corners across an edge are never in contact

std::vector<std::uint32_t> seamNumbers(const Cloth& cloth) {
  std::vector<std::uint32_t> parent(cloth.nodeCount);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    if (tie.c == kNoNode || tie.c == tie.b) parent[root(tie.b)] = root(tie.a);
  }
  for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) parent[k] = root(k);
  return parent;
}

}  // namespace

Incidence incidenceOf(std::size_t keys, const std::vector<KeyValue>& items) {
  Incidence list;
  list.start.assign(keys + 1, 0);
  list.item.resize(items.size());
  for (const auto& [key, value] : items) ++list.start[key + 1];
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  std::vector<std::uint32_t> fill(list.start.begin(), list.start.end() - 1);
  for (const auto& [key, value] : items) list.item[fill[key]++] = value;
  return list;
}

ClothTopology::ClothTopology(const Cloth& cloth, double radius) : live(cloth.nodeCount, 0), seam_(seamNumbers(cloth)) {
  std::vector<KeyValue> byNode;
  std::vector<std::pair<std::array<NodeIndex, 2>, NodeIndex>> sides;  // edge and the corner opposite
  for (const ClothPiece& part : cloth.pieces) {
    const Lattice& lattice = *part.lattice;
    piece.insert(piece.end(), lattice.nodes.size(), static_cast<std::uint32_t>(&part - cloth.pieces.data()));
    layer.insert(layer.end(), lattice.nodes.size(), part.layer);
    paper.insert(paper.end(), lattice.nodes.begin(), lattice.nodes.end());
    std::fill_n(live.begin() + part.firstNode, lattice.nodes.size(), part.live ? 1 : 0);
    for (const Triangle& f : lattice.faces) {
      const Triangle face{part.firstNode + f[0], part.firstNode + f[1], part.firstNode + f[2]};
      for (int c = 0; c < 3; ++c) {
        byNode.emplace_back(face[c], static_cast<std::uint32_t>(faces.size()));
        const auto [low, high] = std::minmax(face[c], face[(c + 1) % 3]);
        sides.push_back({{low, high}, face[(c + 2) % 3]});
      }
      faces.push_back(face);
    }
  }
  facesOf = incidenceOf(cloth.nodeCount, byNode);
  std::sort(sides.begin(), sides.end());
  byNode.clear();

  std::vector<KeyValue> memberOf;
  for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) memberOf.emplace_back(seam_[k], k);
  const Incidence partners = incidenceOf(cloth.nodeCount, memberOf);
  // A node is in contact with what lies beside its partners, or sheets that part at the seam would pass through each
  // other there; not where the band is so narrow that they always would be in contact.
  std::vector<KeyValue> nears, over;
  const auto near = [&](NodeIndex a, NodeIndex b) {
    const bool narrow = distance(paper[a], paper[b]) < kNarrow * radius;
    for (const NodeIndex i : partners.of(seam_[a]))
      for (const NodeIndex j : partners.of(seam_[b])) {
        auto& to = narrow || (i == a && j == b) ? nears : over;
        to.emplace_back(i, j);
        to.emplace_back(j, i);
      }
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& [edge, opposite] = sides[s];
    if (s > 0 && sides[s - 1].first == edge) {
      // Corners across an edge must be able to touch in a fold; not in a band so narrow that they always would.
      const NodeIndex other = sides[s - 1].second;
      if (distance(paper[other], paper[opposite]) < kNarrow * radius) near(other, opposite);
      for (int k = 0; k < 2; ++k) oppositeSides.push_back({opposite, edge[k], other, edge[1 - k]});
      continue;
    }
    near(edge[0], edge[1]);
    for (NodeIndex k : edge) byNode.emplace_back(k, static_cast<std::uint32_t>(edges.size()));
    edges.push_back(edge);
  }
  for (const Tie& tie : cloth.ties)
    if (tie.c != kNoNode && tie.c != tie.b)
      for (const auto& [i, j] : {KeyValue{tie.a, tie.b}, KeyValue{tie.a, tie.c}}) {
        nears.emplace_back(i, j);
        nears.emplace_back(j, i);
      }
  edgesOf = incidenceOf(cloth.nodeCount, byNode);
  sortOnce(nears);
  sortOnce(over);
  near_ = incidenceOf(cloth.nodeCount, nears);
  over_ = incidenceOf(cloth.nodeCount, over);
  sortOppositeSides();
}

void ClothTopology::sortOppositeSides() {
  std::erase_if(oppositeSides, [&](const std::array<NodeIndex, 4>& node) {
    const auto& [a, m, b, n] = node;
    return neighbours(a, b) || sewn(a, n) || sewn(m, b) || sewn(m, n);
  });
  std::sort(oppositeSides.begin(), oppositeSides.end(),
            [](const auto& one, const auto& other) { return std::tie(one[1], one) < std::tie(other[1], other); });
  sidesOf.assign(live.size() + 1, 0);
  for (const auto& node : oppositeSides) ++sidesOf[node[1] + 1];
  std::partial_sum(sidesOf.begin(), sidesOf.end(), sidesOf.begin());
}

std::vector<std::vector<std::uint32_t>> neighboursOf(const Cloth& cloth) {
  std::vector<std::vector<std::uint32_t>> near(cloth.nodeCount);
  const auto join = [&](std::uint32_t a, std::uint32_t b) { near[a].push_back(b), near[b].push_back(a); };
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces)
      for (int k = 0; k < 3; ++k) join(piece.firstNode + f[k], piece.firstNode + f[(k + 1) % 3]);
  for (const Tie& tie : cloth.ties) {
    join(tie.a, tie.b);
    if (tie.c != kNoNode) join(tie.a, tie.c);
  }
  for (auto& own : near) sortOnce(own);
  return near;
}

}  // namespace karinui
