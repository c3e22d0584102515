#include "cloth/closest_points.h"

#include <algorithm>

namespace karinui {

// By the regions of the triangle's corners, edges and inside (Ericson, Real-Time Collision Detection, 5.1.5).
std::array<double, 3> closestOnTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double abAp = dot(ab, ap), acAp = dot(ac, ap);
  if (abAp <= 0 && acAp <= 0) return {1, 0, 0};
  const double abBp = dot(ab, bp), acBp = dot(ac, bp);
  if (abBp >= 0 && acBp <= abBp) return {0, 1, 0};
  const double abCp = dot(ab, cp), acCp = dot(ac, cp);
  if (acCp >= 0 && abCp <= acCp) return {0, 0, 1};
  const double towardC = abAp * acBp - abBp * acAp;
  if (towardC <= 0 && abAp >= 0 && abBp <= 0) {
    const double t = abAp / (abAp - abBp);
    return {1 - t, t, 0};
  }
  const double towardB = abCp * acAp - abAp * acCp;
  if (towardB <= 0 && acAp >= 0 && acCp <= 0) {
    const double t = acAp / (acAp - acCp);
    return {1 - t, 0, t};
  }
  const double towardA = abBp * acCp - abCp * acBp;
  if (towardA <= 0 && acBp - abBp >= 0 && abCp - acCp >= 0) {
    const double t = (acBp - abBp) / ((acBp - abBp) + (abCp - acCp));
    return {0, 1 - t, t};
  }
  const double whole = towardA + towardB + towardC;
  if (!(whole > 0)) return {1, 0, 0};
  const double v = towardB / whole, w = towardC / whole;
  return {1 - v - w, v, w};
}

std::array<double, 2> closestOnSegments(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  const Vec3 u = a1 - a0, v = b1 - b0, r = a0 - b0;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  if (!(uu > 0) || !(vv > 0)) return {0.5, 0.5};
  const double det = uu * vv - uv * uv;
  double s = det > 1e-14 * uu * vv ? std::clamp((uv * vr - ur * vv) / det, 0.0, 1.0) : 0.5;
  double t = (uv * s + vr) / vv;
  if (t < 0) {
    t = 0;
    s = std::clamp(-ur / uu, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((uv - ur) / uu, 0.0, 1.0);
  }
  return {s, t};
}

}  // namespace karinui
