#include "geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/predicates.h"

namespace karinui {
namespace {

double nearestAlong(Vec3 a, Vec3 b, Vec3 from) {
  const double squared = squaredLength(b - a);
  return squared > 0 ? std::clamp(dot(from - a, b - a) / squared, 0.0, 1.0) : 0.0;
}

// The nearest of the three sides: what remains when the face itself has no inside.
std::array<double, 3> nearestOnSides(const Corners& t, Vec3 from) {
  std::array<double, 3> best{1, 0, 0};
  double bestSquared = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double f = nearestAlong(t[k], t[next], from);
    const double squared = squaredLength(lerp(t[k], t[next], f) - from);
    if (squared >= bestSquared) continue;
    bestSquared = squared;
    best = {0, 0, 0};
    best[k] = 1 - f;
    best[next] = f;
  }
  return best;
}

// Puts the corner that stands alone on its side of the other's plane first, and turns the other so that this side is
// its positive one. False when the three corners are not strictly on both sides.
bool makeCanonical(Corners& one, Corners& other) {
  std::array<int, 3> s;
  for (int k = 0; k < 3; ++k) s[k] = side(other[0], other[1], other[2], one[k]);
  if (*std::min_element(s.begin(), s.end()) != -1 || *std::max_element(s.begin(), s.end()) != 1) return false;
  // With a zero between a plus and a minus either may be called alone; the plus is.
  const int pluses = static_cast<int>(std::count(s.begin(), s.end(), 1));
  const int alone = pluses == 1 ? 1 : -1;
  const auto first = std::find(s.begin(), s.end(), alone) - s.begin();
  std::rotate(one.begin(), one.begin() + first, one.end());
  if (alone < 0) std::swap(other[1], other[2]);
  return true;
}

}  // namespace

std::array<double, 3> nearestWeights(const Corners& t, Vec3 from) {
  // Regions of the triangle's plane, after C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = from - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = from - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const Vec3 cp = from - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  const double whole = va + vb + vc;  // four times the squared area
  // A sliver this thin is its sides as far as distances go, while its weights would be rounding noise.
  const double longest = std::max({squaredLength(ab), squaredLength(ac), squaredLength(t[2] - t[1])});
  if (!(whole > 1e-12 * longest * longest)) return nearestOnSides(t, from);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {0, 1 - (d4 - d3) / (d4 - d3 + d5 - d6), (d4 - d3) / (d4 - d3 + d5 - d6)};
  return {1 - vb / whole - vc / whole, vb / whole, vc / whole};
}

double solidAngle(const Corners& t, Vec3 from) {
  const Vec3 a = t[0] - from, b = t[1] - from, c = t[2] - from;
  const double la = length(a), lb = length(b), lc = length(c);
  const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(dot(a, cross(b, c)), below);
}

bool passThrough(Corners one, Corners other) {
  if (!makeCanonical(one, other) || !makeCanonical(other, one)) return false;
  // Both now meet the common line in an interval whose ends lie on the two sides of their first corner; the intervals
  // overlap when neither ends before the other begins.
  return side(one[0], one[1], other[0], other[1]) < 0 && side(one[0], one[2], other[2], other[0]) < 0;
}

}  // namespace karinui
