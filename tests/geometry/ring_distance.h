#pragma once
// How far two rings are apart, side against side: slow, and by nothing that nesting itself uses.
#include <algorithm>

#include "karinui/geometry/polygon.h"

namespace karinui {

inline double sideDistance(Flat a, Flat b, Flat c, Flat d) {
  const double ab = cross(b - a, c - a), ad = cross(b - a, d - a), cd = cross(d - c, a - c), cb = cross(d - c, b - c);
  if ((ab > 0) != (ad > 0) && (cd > 0) != (cb > 0)) return 0;
  return std::min(
      {distanceToSegment(a, b, c), distanceToSegment(a, b, d), distanceToSegment(c, d, a), distanceToSegment(c, d, b)});
}
// 0: they overlap, or one lies within the other.
inline double apart(const Ring& a, const Ring& b) {
  if (contains(a, b[0]) || contains(b, a[0])) return 0;
  double least = 1e9;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      least = std::min(least, sideDistance(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]));
  return least;
}

}  // namespace karinui
