#include "cloth/boundary_activation.h"

#include <algorithm>
#include <span>

#include "cloth/tie_map.h"

namespace karinui {

BoundaryActivation::BoundaryActivation(const Cloth& cloth) : cloth_(cloth) {
  for (const Tie& tie : cloth.ties)
    for (const NodeIndex still : {tie.a, tie.b, tie.c})
      for (const NodeIndex live : {tie.a, tie.b, tie.c})
        if (still != kNoNode && live != kNoNode && !pieceOf(cloth, still).live && pieceOf(cloth, live).live)
          sewnTo_[static_cast<std::size_t>(&pieceOf(cloth, still) - cloth.pieces.data())].push_back(live);
}

std::vector<PieceId> BoundaryActivation::piecesToActivate(const std::vector<Vec3>& before,
                                                          const std::vector<Vec3>& after, const std::vector<Vec3>& x,
                                                          const ColliderList& colliders, const SettleSettings& settings,
                                                          double far, const Token& token, Workers& workers) const {
  Cloth active = cloth_;
  std::vector<Vec3> change(cloth_.nodeCount);
  for (const auto& [piece, nodes] : sewnTo_) {
    active.pieces[piece].live = true;
    for (const NodeIndex k : nodes) change[k] = after[k] - before[k];
  }
  LevelSolver solver(active, x, colliders, settings, settings.clothOnCloth ? clothRadius(active, active.spacing) : 0,
                     workers);
  solver.tieWithin(active.spacing);
  LevelSolver::StepOptions options;
  options.seconds = 0.25;
  options.stopping = {40, 1000, 0.01};
  const std::vector<Vec3> response = solver.responseTo(change, options, token);
  options.gravity = settings.gravity;
  std::vector<Vec3> moves(cloth_.nodeCount);
  solver.predict(options, token, &moves);
  std::vector<PieceId> moving;
  for (const auto& [piece, nodes] : sewnTo_) {
    const ClothPiece& still = cloth_.pieces[piece];
    const auto goesFar = [&](const std::vector<Vec3>& way) {
      const auto own = std::span(way).subspan(still.firstNode, still.lattice->nodes.size());
      return std::any_of(own.begin(), own.end(), [&](Vec3 move) { return squaredLength(move) > far * far; });
    };
    if (goesFar(response) && goesFar(moves)) moving.push_back(still.id);
  }
  return moving;
}

}  // namespace karinui
