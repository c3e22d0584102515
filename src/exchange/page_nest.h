#pragma once
// Pieces laid close together, so that a sheet is cut into few pages.
#include "pdf_tiles.h"

namespace karinui {

// Moves the pieces of a sheet, which are not turned, to where they take fewer pages than they do; or leaves them.
void nestOnPages(Sheet& sheet, const TileGrid& grid);

}  // namespace karinui
