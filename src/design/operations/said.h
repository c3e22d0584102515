#pragma once
// How sentences of operations write numbers.
#include <string>

#include "karinui/base/number.h"

namespace karinui {

inline std::string centimetres(double metres) { return fixed(100 * metres, 1); }

}  // namespace karinui
