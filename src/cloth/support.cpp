#include "karinui/cloth/support.h"

#include "cloth/bending.h"
#include "cloth/edge_bending.h"
#include "cloth/elastic.h"
#include "cloth/lattice_areas.h"
#include "cloth/membrane.h"
#include "cloth/springs.h"
#include "cloth/tie_map.h"

namespace karinui {

std::vector<double> areasOf(const Cloth& cloth) {
  std::vector<double> area(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces) {
    const LatticeAreas shares = latticeAreas(*piece.lattice);
    for (std::size_t k = 0; k < shares.cell.size(); ++k) area[piece.firstNode + k] = shares.cell[k] + shares.ring[k];
  }
  return area;
}

std::vector<Vec3> supportOf(const Cloth& cloth, const ClothState& state, Vec3 gravity, Workers& workers) {
  std::vector<std::uint8_t> held(cloth.nodeCount, 1);
  std::vector<double> weight(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    for (std::size_t k = 0; k < piece.lattice->nodes.size() && piece.live; ++k) {
      held[piece.firstNode + k] = 0;
      weight[piece.firstNode + k] = piece.fabric.weight;
    }
  for (const std::uint32_t node : cloth.pinned) held[node] = 1;

  const std::vector<double> area = areasOf(cloth);
  std::vector<Vec3> force(cloth.nodeCount), areas(cloth.nodeCount);
  const GridLayout layout(cloth);
  Membrane(cloth).addGradient(state.position, force, workers);
  Springs(simclothSprings(cloth), cloth.nodeCount).addGradient(state.position, force, workers);
  Springs(edgeSprings(cloth), cloth.nodeCount).addGradient(state.position, force, workers);
  Springs(elasticSprings(cloth), cloth.nodeCount).addGradient(state.position, force, workers);
  Bending(cloth, held, layout, workers).addGradient(state.position, force, workers);
  for (std::size_t k = 0; k < force.size(); ++k) {
    force[k] -= gravity * (weight[k] * area[k]);
    areas[k] = {area[k], 0, 0};
  }
  for (const auto& [node, more] : edgeMasses(cloth)) force[node] -= gravity * more;
  const TieMap ties(cloth, held, std::vector<std::uint8_t>(cloth.ties.size(), 1));
  std::vector<Vec3> together, apart(cloth.nodeCount), shared;
  ties.reduce(force, together);
  ties.reduce(areas, shared);
  for (std::size_t u = 0; u < together.size(); ++u)
    together[u] = shared[u].x > 0 ? together[u] * (1 / shared[u].x) : Vec3{};
  ties.expand(together, apart);
  return apart;
}

}  // namespace karinui
