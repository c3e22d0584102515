#pragma once
// Patterns drawn as SVG by other programs: FreeSewing, Inkscape, Valentina and Seamly2D, and whatever draws each piece
// as a closed line at true size (docs/format/exchange.md). Our own sheets are read back exactly (readSvg in sheet.h).
// Pure; any thread. Metres here; millimetres, centimetres, inches or pixels there, as the drawing says.
#include <string_view>

#include "karinui/exchange/dxf.h"

namespace karinui {

// Flat pieces, seam lines where the drawing has cut lines as well, grain lines, notches and inner lines where it names
// them; what was guessed or left out is in `notes`. Such a file holds no sizes and no seams. Refused: what is no
// drawing, a DOCTYPE with declarations of its own, and a drawing without a closed line. `unit`: metres of a unit of the
// drawing, whatever it tells itself; 0: as it tells.
Result<CadPattern> readDrawing(std::string_view svg, std::string_view size = {}, double unit = 0);

}  // namespace karinui
