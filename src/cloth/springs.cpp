#include "cloth/springs.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace karinui {
namespace {

// A finished edge takes over beyond this pull; below it cloth stretches as its fabric says, so that a strip with hems
// still has exactly the fabric's modulus.
constexpr double kHemPull = 20;      // N/m
constexpr double kSeamPull = 2;      // N/m, stitches take over sooner
constexpr double kEdgeStrength = 4;  // stiffness of the edge in widths of one spacing of cloth

}  // namespace

Springs::Springs(const std::vector<Spring>& springs, std::size_t nodeCount) {
  std::vector<std::array<NodeIndex, 2>> nodes;
  for (const Spring& s : springs) {
    nodes.push_back({s.a, s.b});
    length_.push_back(s.length);
    stiffness_.push_back(s.stiffness);
  }
  setElements(std::move(nodes), nodeCount);
}

double Springs::elementValue(std::size_t e, const Corners& x) const {
  const double longer = distance(x[0], x[1]) - length_[e];
  return longer > 0 ? 0.5 * stiffness_[e] * longer * longer : 0;
}

void Springs::elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 2> out) const {
  const Vec3 d = x[1] - x[0];
  const double l = length(d), longer = l - length_[e];
  out[1] = longer > 0 ? d * (stiffness_[e] * longer / l) : Vec3{};
  out[0] = -out[1];
}

void Springs::elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const {
  for (Block3& block : out) block = {};
  const Vec3 d = x[1] - x[0];
  const double l = length(d), longer = l - length_[e];
  if (longer <= -slackTolerance_ || !(l > 0)) return;
  const double across = stiffness_[e] * std::fmax(0.0, longer) / l, along = stiffness_[e] - across;
  const Vec3 n = d * (1 / l);
  addIdentityAndOuter(out[0], across, along, n);
  addIdentityAndOuter(out[3], across, along, n);
  addIdentityAndOuter(out[1], -across, -along, n);
  addIdentityAndOuter(out[2], -across, -along, n);
}

Vec3 Springs::tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const {
  Vec3 pull;
  for (std::size_t e = 0; e < count(); ++e) {
    const NodeIndex a = nodes_[e][0], b = nodes_[e][1];
    if (patch[a] == patch[b]) continue;
    const Vec3 d = x[b] - x[a];
    const double l = length(d), longer = l - length_[e];
    if (longer > 0) pull += d * ((patch[a] ? 1 : -1) * stiffness_[e] * longer / l);
  }
  return pull;
}

std::vector<Springs::Spring> simclothSprings(const Cloth& cloth) {
  std::vector<Springs::Spring> springs;
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.live || piece.fabric.law != Fabric::Law::Simcloth) continue;
    const Lattice& lattice = *piece.lattice;
    const double k = piece.fabric.stretchWarp;  // constant, whatever the direction
    std::set<std::pair<NodeIndex, NodeIndex>> have;
    const auto add = [&](NodeIndex a, NodeIndex b) {
      if (a == kNoNode || b == kNoNode || !have.insert(std::minmax(a, b)).second) return;
      springs.push_back({piece.firstNode + a, piece.firstNode + b, distance(lattice.nodes[a], lattice.nodes[b]), k});
    };
    const auto node = [&](std::int64_t i, std::int64_t j) {
      return i < 0 || j < 0 || i >= lattice.columns || j >= lattice.rows ? kNoNode
                                                                         : lattice.grid[j * lattice.columns + i];
    };
    const auto whole = [&](std::int64_t i, std::int64_t j) {
      return i >= 0 && j >= 0 && i + 1 < lattice.columns && j + 1 < lattice.rows &&
             lattice.cell[j * (lattice.columns - 1) + i] != 0;
    };
    for (std::int64_t j = 0; j < lattice.rows; ++j)
      for (std::int64_t i = 0; i < lattice.columns; ++i) {
        const auto along = [&](std::int64_t a, std::int64_t b) { return whole(a, b) || whole(a, b - 1); };
        const auto up = [&](std::int64_t a, std::int64_t b) { return whole(a, b) || whole(a - 1, b); };
        if (along(i, j)) add(node(i, j), node(i + 1, j));
        if (up(i, j)) add(node(i, j), node(i, j + 1));
        if (whole(i, j)) {
          add(node(i, j), node(i + 1, j + 1));
          add(node(i + 1, j), node(i, j + 1));
        }
        // One further, where the cloth between is there.
        if (along(i, j) && along(i + 1, j)) add(node(i, j), node(i + 2, j));
        if (up(i, j) && up(i, j + 1)) add(node(i, j), node(i, j + 2));
      }
    for (const Triangle& face : lattice.faces)  // the ring: every edge that is not yet one
      for (int a = 0; a < 3; ++a) add(face[a], face[(a + 1) % 3]);
  }
  return springs;
}

std::vector<Springs::Spring> edgeSprings(const Cloth& cloth) {
  std::vector<std::uint8_t> sewn(cloth.nodeCount, 0);
  for (const Tie& tie : cloth.ties) {
    sewn[tie.a] = sewn[tie.b] = 1;
    if (tie.c != kNoNode) sewn[tie.c] = 2;  // the folded pair is gathered; its edge is left to the cloth
    if (tie.c != kNoNode) sewn[tie.b] = 2;
  }
  std::vector<Springs::Spring> springs;
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.live || piece.fabric.law != Fabric::Law::Woven) continue;
    const Lattice& lattice = *piece.lattice;
    const double mean = 0.5 * (piece.fabric.stretchWarp + piece.fabric.stretchWeft);
    const auto ring = [&](const std::vector<std::uint32_t>& nodes) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const NodeIndex a = nodes[k], b = nodes[(k + 1) % nodes.size()];
        if (a == b) continue;
        const bool seam = sewn[piece.firstNode + a] == 1 && sewn[piece.firstNode + b] == 1;
        const double l = distance(lattice.nodes[a], lattice.nodes[b]);
        if (!(l > 0)) continue;
        const double free = (seam ? kSeamPull : kHemPull) / mean;
        springs.push_back(
            {piece.firstNode + a, piece.firstNode + b, l * (1 + free), kEdgeStrength * mean * lattice.spacing / l});
      }
    };
    ring(lattice.border);
    for (const auto& hole : lattice.holes) ring(hole);
  }
  return springs;
}

}  // namespace karinui
