#include "eye_view.h"

#include <cmath>

namespace karinui::room {

Eye eyeOfFov(const Rigid& pose, const FieldOfView& fov, double near, double far) {
  const Vec3 right = pose.turned({1, 0, 0}), up = pose.turned({0, 1, 0}), back = pose.turned({0, 0, 1});
  return {viewOf(pose.carry, right, up, back),
          frustumOf({std::tan(fov.left), std::tan(fov.right), std::tan(fov.down), std::tan(fov.up)}, near, far),
          pose.carry};
}

OnPicture onEyePicture(const FieldOfView& fov, Vec3 q, double width, double height) {
  const double l = std::tan(fov.left), r = std::tan(fov.right), u = std::tan(fov.up), d = std::tan(fov.down);
  if (q.z >= 0) return {0, 0, -q.z};
  return {(q.x / -q.z - l) / (r - l) * width, (u - q.y / -q.z) / (u - d) * height, -q.z};
}

}  // namespace karinui::room
