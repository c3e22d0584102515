#pragma once
// Nearest places of a point and a triangle, and of two segments. Weights sum to one on each side.
#include <array>

#include "karinui/geometry/vec.h"

namespace karinui {

std::array<double, 3> nearestOnTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);
std::array<double, 2> nearestOnSegments(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);  // fractions along a and b

}  // namespace karinui
