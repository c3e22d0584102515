#pragma once
#include "karinui/geometry/vec.h"

namespace karinui {

inline void put(float (&to)[3], Vec3 v) {
  to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z);
}

}  // namespace karinui
