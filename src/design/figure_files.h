#pragma once
// Mannequins that were made, in the folder that the environment names by KARINUI_FIGURES, for the programs that come
// after: a made one takes a second, a read one some hundredths. Not set: none is kept. Another version finds none of
// this one's; whoever changes how figures are made empties the folder, as ./test does. Several programs may use it at
// once.
#include <string_view>

#include "karinui/body/body.h"

namespace karinui {

// Null where there is none, or where what is there is damaged. `madeFrom`: all that the figure is made from.
BodyPtr readFigureFile(std::string_view madeFrom);
// A folder that cannot be written to is no error: the figure is there all the same.
void writeFigureFile(std::string_view madeFrom, const Body& body);

}  // namespace karinui
