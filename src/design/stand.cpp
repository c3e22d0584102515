#include "karinui/design/document.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

Stand::Stand(const Piece& piece) : pose_(piece.pose), form_(piece.form) {
  if (form_ && !form_->faces.empty()) {
    finder_ = std::make_shared<const LatticeFinder>(form_->flat, form_->faces);
  } else {
    form_ = nullptr;
  }
}

Vec3 Stand::operator()(Flat place) const {
  if (!form_) return pose_({place.u, place.v, 0});
  const LatticePlace at = finder_->find(place);
  Vec3 sum;
  for (std::size_t i = 0; i < 3; ++i) sum += at.weight[i] * form_->space[at.face[i]];
  return pose_(sum);
}

}  // namespace karinui
