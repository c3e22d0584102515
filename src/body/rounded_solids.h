#pragma once
// Signed distances of simple solids, and how they are joined smoothly: what heads, hands and feet are modelled from.
// Negative inside; near the surface within some per cent of the distance. Metres. Pure functions.
// The rounded cone and the smooth minimum are those of I. Quilez, "Distance functions" and "Smooth minimum".
#include <algorithm>
#include <cmath>

#include "karinui/geometry/vec.h"

namespace karinui {

// The hull of two balls.
inline double roundedCone(Vec3 at, Vec3 p, Vec3 q, double r0, double r1) {
  const Vec3 axis = q - p, from = at - p;
  const double size = squaredLength(axis), thinner = r0 - r1, flank = size - thinner * thinner;
  const double y = dot(from, axis), z = y - size, x = squaredLength(from * size - axis * y), y2 = y * y * size,
               z2 = z * z * size, k = (thinner < 0 ? -1 : 1) * thinner * thinner * x;
  if ((z < 0 ? -1 : 1) * flank * z2 > k) return std::sqrt(x + z2) / size - r1;
  if ((y < 0 ? -1 : 1) * flank * y2 < k) return std::sqrt(x + y2) / size - r0;
  return (std::sqrt(x * flank / size) + y * thinner) / size - r0;
}

inline double ellipsoid(Vec3 at, Vec3 centre, Vec3 radii) {
  const Vec3 p = at - centre;
  const double near = length({p.x / radii.x, p.y / radii.y, p.z / radii.z});
  const double slope = length({p.x / (radii.x * radii.x), p.y / (radii.y * radii.y), p.z / (radii.z * radii.z)});
  return slope < 1e-9 ? -std::min({radii.x, radii.y, radii.z}) : near * (near - 1) / slope;
}

// Where two surfaces meet, a fillet about as wide as `k`.
inline double smoothUnion(double a, double b, double k) {
  if (k <= 0) return std::min(a, b);
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}
inline double smoothCommon(double a, double b, double k) { return -smoothUnion(-a, -b, k); }

}  // namespace karinui
