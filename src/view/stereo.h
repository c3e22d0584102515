#pragma once
// Two eyes' pictures in one for red-cyan glasses.
#include "karinui/view/image.h"

namespace karinui {

// Both of the same size. Colours by least squares between what each filter lets through and the true picture:
// E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001 (matrices for sRGB screens).
Image anaglyph(const Image& left, const Image& right);

}  // namespace karinui
