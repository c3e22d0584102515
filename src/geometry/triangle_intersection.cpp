#include "karinui/geometry/triangle_intersection.h"

#include <cmath>

namespace karinui {
namespace {

__extension__ typedef __int128 Whole;  // differences of 41 bits: a determinant needs 126

// The side of the plane a, b, c on which d lies: -1, 0 or 1.
int side(const NanoPoint& a, const NanoPoint& b, const NanoPoint& c, const NanoPoint& d) {
  const Whole bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const Whole cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const Whole dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
  const Whole det = bx * (cy * dz - cz * dy) - by * (cx * dz - cz * dx) + bz * (cx * dy - cy * dx);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

}  // namespace

NanoPoint toNano(Vec3 place) {
  return {std::llround(place.x * 1e9), std::llround(place.y * 1e9), std::llround(place.z * 1e9)};
}

bool segmentCrossesTriangle(const NanoPoint& p, const NanoPoint& q, const std::array<NanoPoint, 3>& t) {
  if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
  const int s = side(p, q, t[0], t[1]);
  return s != 0 && side(p, q, t[1], t[2]) == s && side(p, q, t[2], t[0]) == s;
}

bool trianglesIntersect(const std::array<NanoPoint, 3>& a, const std::array<NanoPoint, 3>& b) {
  for (int k = 0; k < 3; ++k)
    if (segmentCrossesTriangle(a[k], a[(k + 1) % 3], b) || segmentCrossesTriangle(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

}  // namespace karinui
