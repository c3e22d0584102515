#pragma once
// The colours of a map, of strain or of pressure: from dark blue (slack) through grey to bright yellow (tight).
// Lightness rises evenly, so the order is read by every kind of colour vision and on a black-and-white print. Pure; any
// thread.
#include "karinui/scene/scene_frame.h"

namespace karinui {

// share in [0, 1] of the scale; what lies outside gets the end colour. Linear RGB.
Colour strainColour(double share);

// A round number (1, 2 or 5 times a power of ten, at least 0.5 %) that holds 99 of 100 of the frame's strains, as the
// top of a scale. 0 when the frame carries no strain at all.
double strainTop(const SceneFrame& frame);

}  // namespace karinui
