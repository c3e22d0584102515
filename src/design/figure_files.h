#pragma once
// Mannequins that were made, in the folder that the environment names by KARINUI_FIGURES, for the programs that come
// after: a made one takes a second, a read one some hundredths. Not set: none is kept. The folder is of one build of
// Karinui, since another may make another figure from the same measurements; the tests begin with an empty one. Several
// programs may use it at once.
#include <string_view>

#include "karinui/body/body.h"

namespace karinui {

// Null where there is none, or where what is there is damaged. `madeFrom`: all that the figure is made from.
BodyPtr readFigureFile(std::string_view madeFrom);
// A folder that cannot be written to is no error: the figure is there all the same.
void writeFigureFile(std::string_view madeFrom, const Body& body);

}  // namespace karinui
