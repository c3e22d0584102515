#pragma once
// Cloth that is stood over cloth: folded into pleats, or laid on another piece.
#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/pattern/piece.h"

namespace karinui {

inline constexpr double kLayersApart = 0.003;  // metres: a little more than the drape keeps cloth from cloth

struct LiftedPlace {
  Flat place;           // on the paper of the piece beneath,
  double metres = 0;    // and how far out from it, on its right side
  bool beyond = false;  // a place beside the paper lies as far beside the cloth; otherwise on its edge
};
// The form of `piece`, before the pose of `beneath`, each of its places where `over` says.
Result<std::shared_ptr<const Form>> liftedForm(const Piece& piece, const Piece& beneath, double spacing,
                                               const std::function<LiftedPlace(Flat)>& over);

// The nodes of a piece at which its layers are sewn to each other by these seams.
Result<std::set<std::pair<double, double>>> nodesOfSewnLayers(const Piece& piece, double spacing,
                                                              const std::vector<const Seam*>& seams);

}  // namespace karinui
