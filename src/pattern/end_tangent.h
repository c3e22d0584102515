#pragma once
#include "karinui/geometry/curve.h"

namespace karinui {

// The unit tangent at an end of a curve, also where a handle has no length: the direction of what follows it.
inline Flat endTangent(const Curve& curve, bool atEnd) {
  for (const double t : {0.0, 1e-6, 1e-3, 0.1})
    if (const Flat way = curve.tangent(atEnd ? 1 - t : t); length(way) > 1e-9) return normalized(way);
  return normalized(curve.end - curve.start);
}

}  // namespace karinui
