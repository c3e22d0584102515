#pragma once
// Words on a finished picture: captions top left, the strain scale with its numbers top right. Sizes follow the
// picture's.
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/view/lettering.h"

namespace karinui {

inline constexpr Pixel kInk{58, 52, 46, 255};  // warm dark grey

void writeCaptions(Image& image, Lettering& lettering, const std::vector<std::string>& captions);
void drawStrainLegend(Image& image, Lettering& lettering, double top, Language language);

}  // namespace karinui
