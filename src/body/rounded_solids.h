#pragma once
// Signed distances of simple solids, and how they are joined smoothly: what heads, hands and feet are modelled from.
// Negative inside; near the surface within some per cent of the distance. Metres. Pure functions.
// The smooth minimum is the quadratic one of I. Quilez, "Smooth minimum".
#include <algorithm>
#include <cmath>

#include "karinui/geometry/vec.h"

namespace karinui {

// The hull of two balls, around p and q.
inline double roundedCone(Vec3 at, Vec3 p, Vec3 q, double r0, double r1) {
  const Vec3 axis = q - p, from = at - p;
  const double size = length(axis), along = dot(from, axis) / size,
               off = std::sqrt(std::max(0.0, squaredLength(from) - along * along));
  const double sine = (r0 - r1) / size, cosine = std::sqrt(std::max(0.0, 1 - sine * sine));  // of the flank's slope
  const double foot = along * cosine - off * sine;  // along the flank, from where the ball around p ends
  if (foot < 0) return std::hypot(off, along) - r0;
  if (foot > size * cosine) return std::hypot(off, along - size) - r1;
  return off * cosine + along * sine - r0;
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
