#include "cloth/edge_bending.h"

#include <cmath>
#include <set>

#include "cloth/bend_along.h"

namespace karinui {

namespace {

// The node beside one of the edge that lies most squarely within; kNoNode: the edge is all there is.
std::uint32_t beside(const Lattice& lattice, const std::set<std::uint32_t>& onEdge, std::uint32_t node, Flat along) {
  std::uint32_t best = kNoNode;
  double most = 0.3;  // sine of the angle to the edge
  for (const Triangle& face : lattice.faces)
    for (int c = 0; c < 3; ++c) {
      if (face[c] != node) continue;
      for (const std::uint32_t other : {face[(c + 1) % 3], face[(c + 2) % 3]}) {
        if (onEdge.contains(other)) continue;
        const Flat way = lattice.nodes[other] - lattice.nodes[node];
        const double sine = std::fabs(cross(along, normalized(way)));
        if (sine > most) most = sine, best = other;
      }
    }
  return best;
}

}  // namespace

EdgeBending::EdgeBending(const Cloth& cloth) {
  std::vector<std::array<NodeIndex, 4>> nodes;
  const auto add = [&](const ClothEdge& edge, auto stiffness) {  // N m2, of the way along the edge
    const ClothPiece& piece = cloth.pieces[edge.piece];
    if (!piece.live || piece.fabric.law != Fabric::Law::Woven) return;
    const Lattice& lattice = *piece.lattice;
    std::set<std::uint32_t> onEdge;
    for (const std::uint32_t node : edge.nodes) onEdge.insert(node - piece.firstNode);
    for (std::size_t k = 1; k + 1 < edge.nodes.size(); ++k) {
      const std::uint32_t a = edge.nodes[k - 1] - piece.firstNode, m = edge.nodes[k] - piece.firstNode,
                          b = edge.nodes[k + 1] - piece.firstNode;
      const Flat along = normalized(lattice.nodes[b] - lattice.nodes[a]);
      const std::uint32_t c = beside(lattice, onEdge, m, along);
      if (c == kNoNode) continue;
      const Flat toA = lattice.nodes[a] - lattice.nodes[m], toB = lattice.nodes[b] - lattice.nodes[m],
                 toC = lattice.nodes[c] - lattice.nodes[m];
      // Three weights whose sum over the ways to the neighbours is nothing: flat cloth has no curvature.
      std::array<double, 3> w{cross(toB, toC), cross(toC, toA), cross(toA, toB)};
      const auto square = [&](Flat way) { return dot(way, along) * dot(way, along); };
      const double second = 0.5 * (w[0] * square(toA) + w[1] * square(toB) + w[2] * square(toC));
      if (std::fabs(second) < 1e-18) continue;
      const double energy = stiffness(along) * 0.5 * (length(toA) + length(toB));  // N m2 m = 2 J at 1/m
      const double scale = std::sqrt(energy) / second;
      for (double& weight : w) weight *= scale;
      nodes.push_back({edge.nodes[k - 1], edge.nodes[k + 1], piece.firstNode + c, edge.nodes[k]});
      weight_.push_back({w[0], w[1], w[2], -w[0] - w[1] - w[2]});
    }
  };
  for (const FoldedBackEdge& strip : cloth.foldedBack)
    add(strip.edge, [&](Flat along) { return bendAlong(cloth.pieces[strip.edge.piece], along) * strip.width; });
  for (const TrimmedEdge& trim : cloth.trims) add(trim.edge, [&](Flat) { return trim.bending; });
  setElements(std::move(nodes), cloth.nodeCount);
}

double EdgeBending::elementValue(std::size_t e, const Corners& x) const {
  Vec3 bent;
  for (int c = 0; c < 4; ++c) bent += x[c] * weight_[e][c];
  return 0.5 * dot(bent, bent);
}

void EdgeBending::elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 4> out) const {
  Vec3 bent;
  for (int c = 0; c < 4; ++c) bent += x[c] * weight_[e][c];
  for (int c = 0; c < 4; ++c) out[c] = bent * weight_[e][c];
}

void EdgeBending::elementBlocks(std::size_t e, const Corners&, std::span<Block3> out) const {
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      out[4 * a + b] = {};
      addIdentityAndOuter(out[4 * a + b], weight_[e][a] * weight_[e][b], 0, {});
    }
}

std::vector<std::pair<NodeIndex, double>> edgeMasses(const Cloth& cloth) {
  std::vector<std::pair<NodeIndex, double>> masses;
  const auto add = [&](const ClothEdge& edge, double width, double weight) {  // m, kg/m2
    const ClothPiece& piece = cloth.pieces[edge.piece];
    if (!piece.live) return;
    for (std::size_t k = 0; k + 1 < edge.nodes.size(); ++k) {
      const NodeIndex a = edge.nodes[k], b = edge.nodes[k + 1];
      const double l = distance(piece.lattice->nodes[a - piece.firstNode], piece.lattice->nodes[b - piece.firstNode]);
      for (const NodeIndex node : {a, b}) masses.emplace_back(node, 0.5 * l * width * weight);
    }
  };
  for (const FoldedBackEdge& strip : cloth.foldedBack)
    add(strip.edge, strip.width, cloth.pieces[strip.edge.piece].fabric.weight);
  for (const TrimmedEdge& trim : cloth.trims) add(trim.edge, 1, trim.weight);
  return masses;
}

}  // namespace karinui
