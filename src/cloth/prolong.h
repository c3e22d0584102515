#pragma once
// Where the nodes of a finer level stand, from a coarser one of the same garment: by place on paper. `straight` lies on
// the coarse triangles; `smooth` adds what their bend says (the mean of the triangle and of its corners' tangent
// planes, exact for a quadratic).
#include <span>
#include <vector>

#include "karinui/cloth/cloth.h"

namespace karinui {

struct Prolonged {
  std::vector<Vec3> straight, smooth;
};
// Pieces are matched by id; nodes of pieces that do not move, or that the coarse level lacks, stay as in `standing`.
Prolonged prolong(const Cloth& coarse, std::span<const Vec3> x, const Cloth& fine, std::span<const Vec3> standing);

}  // namespace karinui
