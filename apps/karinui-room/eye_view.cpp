#include "eye_view.h"

#include <cmath>

namespace karinui::room {

Eye eyeOfFov(const Rigid& pose, const FieldOfView& fov, double near, double far) {
  Eye eye;
  eye.place = pose.carry;
  const Vec3 right = pose.turned({1, 0, 0}), up = pose.turned({0, 1, 0}), back = pose.turned({0, 0, 1}), p = pose.carry;
  eye.view.m = {right.x, up.x, back.x, 0, right.y,        up.y,        back.y,        0,
                right.z, up.z, back.z, 0, -dot(right, p), -dot(up, p), -dot(back, p), 1};
  const double l = std::tan(fov.left), r = std::tan(fov.right), u = std::tan(fov.up), d = std::tan(fov.down);
  eye.projection.m = {2 / (r - l),
                      0,
                      0,
                      0,
                      0,
                      2 / (u - d),
                      0,
                      0,
                      (r + l) / (r - l),
                      (u + d) / (u - d),
                      -(far + near) / (far - near),
                      -1,
                      0,
                      0,
                      -2 * far * near / (far - near),
                      0};
  return eye;
}

OnPicture onEyePicture(const FieldOfView& fov, Vec3 q, double width, double height) {
  const double l = std::tan(fov.left), r = std::tan(fov.right), u = std::tan(fov.up), d = std::tan(fov.down);
  if (q.z >= 0) return {0, 0, -q.z};
  return {(q.x / -q.z - l) / (r - l) * width, (u - q.y / -q.z) / (u - d) * height, -q.z};
}

}  // namespace karinui::room
