#pragma once
// Walking round the fitting: turn, pan and zoom as plain arithmetic on a camera. Metres, radians, pixels.
#include "karinui/devices/space_mouse.h"
#include "karinui/scene/overlay.h"
#include "karinui/scene/pointer.h"
#include "karinui/view/camera.h"

namespace karinui::studio {

Camera turned(const Camera& camera, double right, double up);              // radians about the target
Camera panned(const Camera& camera, double dx, double dy, double height);  // pixels of a picture of this height
// Nearer by `factor` (< 1), so that what is under the ray stays under it.
Camera zoomed(const Camera& camera, double factor, const Ray& towards);
// As a hand on a six-way cap moves what is looked at; shares of a second's way.
Camera carried(const Camera& camera, const CapMotion& cap);
Camera between(const Camera& a, const Camera& b, double t);
Viewpoint sightOf(const Camera& camera, double aspect);
Ray rayAt(const Camera& camera, double x, double y, double width, double height);  // pixels from the top left

}  // namespace karinui::studio
