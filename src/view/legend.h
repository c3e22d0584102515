#pragma once
// Words on a finished picture: captions top left, the scale of the map with its numbers top right. Sizes follow the
// picture's.
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/view/lettering.h"
#include "karinui/view/picture.h"

namespace karinui {

inline constexpr Pixel kInk{58, 52, 46, 255};  // warm dark grey

void writeCaptions(Image& image, Lettering& lettering, const std::vector<std::string>& captions);
// Up to `top`: a strain, or pascals, which are written as kPa.
void drawLegend(Image& image, Lettering& lettering, Map map, double top, Language language);

}  // namespace karinui
