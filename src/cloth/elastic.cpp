#include "cloth/elastic.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kFold = 0.04;  // metres of edge in a fold that an elastic gathers

// One spring, of an elastic's stiffness shared among those that overlap.
struct Span {
  std::uint32_t a = 0, b = 0;
  double onPaper = 0;
  double share = 1;
};

std::vector<Span> spansOf(const Cloth& cloth, const ClothEdge& edge) {
  const ClothPiece& piece = cloth.pieces[edge.piece];
  const std::vector<std::uint32_t>& nodes = edge.nodes;
  const std::size_t n = nodes.size() - 1;  // segments
  std::vector<double> at(nodes.size(), 0);
  for (std::size_t k = 1; k <= n; ++k)
    at[k] = at[k - 1] + distance(piece.lattice->nodes[nodes[k - 1] - piece.firstNode],
                                 piece.lattice->nodes[nodes[k] - piece.firstNode]);
  const auto segments = static_cast<std::size_t>(std::lround(kFold * static_cast<double>(n) / at[n]));
  const std::size_t m = std::clamp<std::size_t>(segments, 1, std::max<std::size_t>(1, n / 4));
  std::vector<Span> spans;
  const auto add = [&](std::size_t from, std::size_t to) {
    spans.push_back({nodes[from], nodes[to], at[to] - at[from], 1 / static_cast<double>(m)});
  };
  const bool ring = nodes.front() == nodes.back();
  for (std::size_t k = 0; k + m <= n; ++k) add(k, k + m);
  for (std::size_t k = 1; k < m; ++k)
    if (ring) {
      spans.push_back({nodes[n - k], nodes[m - k], at[n] - at[n - k] + at[m - k], 1 / static_cast<double>(m)});
    } else {
      add(0, k), add(n - k, n);  // at the ends fewer springs overlap
    }
  return spans;
}

double stiffnessOf(const Span& span, const Elastic& elastic) {
  return elastic.stiffness() * span.share / (elastic.ratio * span.onPaper);
}

}  // namespace

std::vector<Springs::Spring> elasticSprings(const Cloth& cloth) {
  std::vector<Springs::Spring> springs;
  for (const auto& [edge, elastic] : cloth.elastics) {
    if (!cloth.pieces[edge.piece].live) continue;
    for (const Span& span : spansOf(cloth, edge))
      springs.push_back({span.a, span.b, elastic.ratio * span.onPaper, stiffnessOf(span, elastic)});
  }
  return springs;
}

std::vector<ElasticPull> elasticPulls(const Cloth& cloth, const ClothState& state) {
  std::vector<ElasticPull> pulls;
  for (const auto& [edge, elastic] : cloth.elastics) {
    ElasticPull found{cloth.pieces[edge.piece].id, edge.name, elastic.ratio * edge.length, 0, 0};
    double whole = 0;
    for (const Span& span : spansOf(cloth, edge)) {
      const double longer = distance(state.position[span.a], state.position[span.b]) - elastic.ratio * span.onPaper;
      found.pull += std::fmax(0, longer) * stiffnessOf(span, elastic) * span.onPaper;
      whole += span.onPaper * span.share;
    }
    found.pull /= whole;
    found.now = found.cut * (1 + found.pull / elastic.stiffness());
    pulls.push_back(std::move(found));
  }
  return pulls;
}

}  // namespace karinui
