#pragma once
// On which side? Answered right for any doubles that neither overflow nor underflow: a filtered determinant, and exact
// expansion arithmetic where rounding could change the answer.
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997.
#include "karinui/geometry/vec.h"

namespace karinui {

// +1: d lies on the side that the normal of the counter-clockwise triangle abc points to; -1: on the other; 0: on the
// plane.
int side(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

// +1: c lies left of the line from a to b; -1: right; 0: on it.
int side(Flat a, Flat b, Flat c);

}  // namespace karinui
