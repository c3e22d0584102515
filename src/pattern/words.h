#pragma once
// How this module says places and lengths: millimetres, one decimal.
#include <string>

#include "karinui/base/number.h"
#include "karinui/geometry/vec.h"

namespace karinui {

inline std::string inMm(double metres) { return fixed(metres * 1e3, 1); }
inline std::string inMm(Flat place) {
  std::string words("(");
  words.append(inMm(place.u)).append(", ").append(inMm(place.v)).append(")");
  return words;
}

}  // namespace karinui
