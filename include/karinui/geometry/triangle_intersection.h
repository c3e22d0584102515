#pragma once
// Exact predicates of intersection: points are rounded to whole nanometres and everything after that is integer
// arithmetic. Touching is not intersecting.
#include <array>
#include <cstdint>

#include "karinui/geometry/vec.h"

namespace karinui {

struct NanoPoint {
  std::int64_t x = 0, y = 0, z = 0;
};
NanoPoint toNano(Vec3 place);  // |place| below a kilometre
// Whether the segment from p to q passes through the triangle.
bool segmentCrossesTriangle(const NanoPoint& p, const NanoPoint& q, const std::array<NanoPoint, 3>& t);
bool trianglesIntersect(const std::array<NanoPoint, 3>& a, const std::array<NanoPoint, 3>& b);

}  // namespace karinui
