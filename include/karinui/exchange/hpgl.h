#pragma once
// The sheet for pen plotters and cutters.
#include <string>

#include "karinui/exchange/sheet.h"

namespace karinui {

// HPGL, 40 units a millimetre, x along the roll: cut lines, seam lines, inner lines, notches, drill holes, grain,
// lettering in ASCII. Pure; any thread.
Result<std::string> writeHpgl(const Pattern& pattern, const SheetSettings& settings = {});

}  // namespace karinui
