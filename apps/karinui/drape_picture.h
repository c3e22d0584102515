#pragma once
// The drape tester as a picture: the disc hangs over its support, seen from above and a little from the side.
#include "bench/cusick.h"
#include "karinui/view/picture.h"

namespace karinui::app {

Result<Image> drapePicture(Picture& picture, const bench::Draped& draped, int pixels);

}  // namespace karinui::app
