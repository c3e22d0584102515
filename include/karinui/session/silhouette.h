#pragma once
// Cloth in a photograph from straight above, on a plain ground of another colour. Pure; any thread.
#include "karinui/design/print_image.h"

namespace karinui {

// The share of the picture that the cloth covers. Refused, saying why: no ground to tell it from, nothing on it, cloth
// that reaches the picture's edge.
Result<double> coveredShare(const PrintPixels& photograph);

// The drape coefficient of a disc (cloth/drape_disc.h) from two photographs by a camera that did not move: the disc
// flat at the height of its support, and draped.
Result<double> drapeOfPhotographs(const PrintPixels& flat, const PrintPixels& draped);

}  // namespace karinui
