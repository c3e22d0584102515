#pragma once
// Drawings of programs that know nothing of the cutting trade's layers (Illustrator, Inkscape, LibreCAD, Rhino): what
// their lines are is told by the layers' names, else by which line lies within which. Pure.
#include <string>
#include <vector>

#include "dxf_shapes.h"
#include "dxf_text.h"

namespace karinui {

// How far apart ends may be that are one place, in the file's unit: some tenth of a millimetre in a sheet of pieces.
double slipOf(const std::vector<DxfShape>& shapes);
// Puts lines on the layers of the trade: closed ones on 1, those that do not close on 8, all that a layer's name says
// on its own. A rectangle round everything is a frame and on none.
void putOnLayers(std::vector<DxfShape>& shapes);
// Of the shapes of one piece: a line within the outline that is nearly as large is the seam line, what is smaller is an
// inner line.
void tellInnerLines(std::vector<DxfShape>& shapes);
// The piece's name: lettering, else what its layer is called; empty where neither says anything.
std::string plainNameOf(const std::vector<DxfShape>& shapes, const DxfWords& words);

}  // namespace karinui
