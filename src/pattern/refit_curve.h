#pragma once
// One curve in the place of two that follow each other, when the point between them is taken away.
#include "karinui/geometry/curve.h"

namespace karinui {

// Two straight lines: the straight line. Parts of one curve: that curve. Two that meet smoothly (within two degrees):
// the fewest cubics within a tenth of a millimetre of both. Two that meet at a corner: the fewest smooth cubics within
// half a millimetre of what lies away from the corner, that is beyond a third of the shorter one; the rest rounds it.
// Starts where the first does and ends where the second does, in the same directions.
Curve refitted(const Curve& first, const Curve& second);

}  // namespace karinui
