#pragma once
// From what a headset says of an eye to what the renderer draws with. Pure; any thread.
#include "karinui/view/camera.h"

namespace karinui::room {

// The half angles of a view, radians, as OpenXR gives them: left and down are negative of an eye that looks ahead.
struct FieldOfView {
  double left = -0.7, right = 0.7, up = 0.7, down = -0.7;
  bool operator==(const FieldOfView&) const = default;
};

// `pose`: the eye in the space that is drawn, looking along its -z. near, far: metres of that space, 0 < near < far.
// The frustum of the OpenXR specification (XrFovf) with the depths of OpenGL.
Eye eyeOfFov(const Rigid& pose, const FieldOfView& fov, double near, double far);

// Where a point falls in this eye's picture, by the closed form alone: pixels from the top left. `inEye`: the point in
// the eye's own space.
OnPicture onEyePicture(const FieldOfView& fov, Vec3 inEye, double width, double height);

}  // namespace karinui::room
