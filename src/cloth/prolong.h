#pragma once
// Prolongation: where the nodes of a finer level stand, interpolated on paper from a coarser level of the same garment.
// `linear` lies on the coarse triangles; `quadratic` is the mean of that and of the corners' tangent planes, exact for
// quadratics.
#include <span>
#include <vector>

#include "karinui/cloth/cloth.h"

namespace karinui {

struct Prolonged {
  std::vector<Vec3> linear, quadratic;
};
// Pieces are matched by id; nodes of pieces that do not move, or that the coarse level lacks, stay as in `standing`.
Prolonged prolong(const Cloth& coarse, std::span<const Vec3> x, const Cloth& fine, std::span<const Vec3> standing);

}  // namespace karinui
