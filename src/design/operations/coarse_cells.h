#pragma once
// Cells that are too wide for what the cloth lies round.
#include "karinui/design/apply.h"

namespace karinui {

// Advises finer cells where an opening of the draped garment, such as a cuff, goes round a limb in few of them and so
// presses as no cloth does: it is a polygon of few corners. Nothing is told of cells of the usual width.
void tellCoarseCells(const Document& draped, Context& context);

}  // namespace karinui
