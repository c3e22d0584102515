#pragma once
// Joints as indices, and the two sides of a pair.
#include <cstddef>

#include "karinui/body/pose.h"

namespace karinui {

inline std::size_t index(Joint joint) { return static_cast<std::size_t>(joint); }

// Of a pair of joints the left (0) or the right (1), named by the left one.
inline Joint sided(Joint left, int side) { return static_cast<Joint>(static_cast<int>(left) + side); }

}  // namespace karinui
