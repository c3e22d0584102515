#pragma once
// Closest points of a point and a triangle, and of two segments, as barycentric weights.
#include <array>

#include "karinui/geometry/vec.h"

namespace karinui {

std::array<double, 3> closestOnTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);
std::array<double, 2> closestOnSegments(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);  // fractions along a and b

}  // namespace karinui
