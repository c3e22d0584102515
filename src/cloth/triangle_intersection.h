#pragma once
// Whether two triangles pass through each other, decided exactly: places are rounded to whole nanometres first and all
// after that is whole-number arithmetic. Touching is not crossing.
#include <array>
#include <cstdint>

#include "karinui/geometry/vec.h"

namespace karinui {

struct NanoPoint {
  std::int64_t x = 0, y = 0, z = 0;
};
NanoPoint toNano(Vec3 place);  // |place| below a kilometre
// Whether the edge from p to q passes through the triangle.
bool segmentCrossesTriangle(const NanoPoint& p, const NanoPoint& q, const std::array<NanoPoint, 3>& t);
bool trianglesIntersect(const std::array<NanoPoint, 3>& a, const std::array<NanoPoint, 3>& b);

}  // namespace karinui
