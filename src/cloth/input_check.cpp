#include "cloth/input_check.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kFarthest = 1000;  // metres from the origin: beyond it a place is a mistake

}  // namespace

Done checkLevel(const ClothLevel& level) {
  const Cloth& cloth = level.cloth;
  if (level.state.position.size() != cloth.nodeCount)
    return badInput(say("The cloth has {0} {0|point|points} but its state has {1}.", std::size_t{cloth.nodeCount},
                        level.state.position.size()));
  if (!(cloth.spacing > 0) || !std::isfinite(cloth.spacing)) return badInput(say("The cloth has no spacing."));
  std::uint32_t nodes = 0;
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.lattice || piece.firstNode != nodes)
      return badInput(say("The piece “{0}” has not been laid as cloth.", piece.name));
    nodes += static_cast<std::uint32_t>(piece.lattice->nodes.size());
    if (nodes > cloth.nodeCount) break;
    if (const auto fine = checkFabric(piece.fabric); !fine) return fine.error();
    for (std::uint32_t k = piece.firstNode; k < nodes; ++k)
      if (!finite(level.state.position[k]) || length(level.state.position[k]) > kFarthest)
        return badInput(say("The piece “{0}” does not stand anywhere sensible; place it again.", piece.name));
  }
  if (nodes != cloth.nodeCount) return badInput(say("The cloth does not have the points of its pieces."));
  for (const Tie& tie : cloth.ties)
    if (tie.a >= nodes || tie.b >= nodes || (tie.c != kNoNode && tie.c >= nodes))
      return badInput(say("A seam speaks of cloth that is not there."));
  for (std::uint32_t k : cloth.pinned)
    if (k >= nodes) return badInput(say("A pin speaks of cloth that is not there."));
  return {};
}

Done checkSettings(const SettleSettings& s) {
  const bool fine = finite(s.gravity) && length(s.gravity) < 1000 && s.stopMove > 0 && std::isfinite(s.stopMove) &&
                    s.stopResidual > 0 && s.maxSteps > 0 && s.maxSteps < 10'000'000 && s.skin > 0 && s.skin < 0.1;
  if (!fine) return badInput(say("The settings of the drape make no sense (gravity, stop, steps or skin)."));
  return {};
}

}  // namespace karinui
