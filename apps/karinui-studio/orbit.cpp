#include "orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui::studio {

Camera turned(const Camera& camera, double right, double up) {
  Vec3 arm = camera.eye - camera.target;
  const double far = length(arm);
  double yaw = std::atan2(arm.x, arm.z) - right;
  double pitch = std::asin(std::clamp(arm.y / far, -1.0, 1.0)) + up;
  pitch = std::clamp(pitch, -1.45, 1.5);
  Camera after = camera;
  after.eye =
      camera.target + Vec3{std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)} * far;
  return after;
}

Camera panned(const Camera& camera, double dx, double dy, double height) {
  const double scale = 2 * camera.distance() * std::tan(camera.fieldOfView / 2) / height;
  const Vec3 right = camera.right(), up = cross(normalized(camera.eye - camera.target), right);
  const Vec3 step = right * (-dx * scale) + up * (dy * scale);
  Camera after = camera;
  after.eye += step;
  after.target += step;
  return after;
}

Camera zoomed(const Camera& camera, double factor, const Ray& towards) {
  const double far = camera.distance();
  factor = std::clamp(factor, 0.15 / far, 30 / far);
  // The place at the target's depth that is under the ray stays there.
  const Vec3 back = normalized(camera.eye - camera.target);
  const double along = -dot(towards.direction, back);
  const Vec3 fixed = along > 1e-3 ? towards.origin + towards.direction * (far / along) : camera.target;
  Camera after = camera;
  after.eye = fixed + (camera.eye - fixed) * factor;
  after.target = fixed + (camera.target - fixed) * factor;
  return after;
}

Camera carried(const Camera& camera, const CapMotion& cap) {
  constexpr double kTurn = 1.6, kPan = 0.7, kZoom = 1.4;  // radians, heights of the view, powers of e in a second
  Camera after = turned(camera, kTurn * cap.turn * cap.seconds, kTurn * cap.tilt * cap.seconds);
  after = panned(after, kPan * cap.right * cap.seconds, -kPan * cap.up * cap.seconds, 1);
  return zoomed(after, std::exp(kZoom * cap.away * cap.seconds), {after.eye, normalized(after.target - after.eye)});
}

Camera between(const Camera& a, const Camera& b, double t) {
  // Round the target, not through it.
  const auto angles = [](const Camera& c) {
    const Vec3 arm = c.eye - c.target;
    return std::array{std::atan2(arm.x, arm.z), std::asin(std::clamp(arm.y / length(arm), -1.0, 1.0)), length(arm)};
  };
  const auto from = angles(a);
  auto to = angles(b);
  while (to[0] - from[0] > std::numbers::pi) to[0] -= 2 * std::numbers::pi;
  while (to[0] - from[0] < -std::numbers::pi) to[0] += 2 * std::numbers::pi;
  const auto mix = [&](std::size_t k) { return from[k] + (to[k] - from[k]) * t; };
  Camera c = b;
  c.target = lerp(a.target, b.target, t);
  c.eye = c.target +
          Vec3{std::sin(mix(0)) * std::cos(mix(1)), std::sin(mix(1)), std::cos(mix(0)) * std::cos(mix(1))} * mix(2);
  return c;
}

Viewpoint sightOf(const Camera& camera, double aspect) {
  Viewpoint sight;
  sight.eye = camera.eye;
  sight.back = normalized(camera.eye - camera.target);
  sight.right = camera.right();
  sight.up = cross(sight.back, sight.right);
  sight.tanHalf = std::tan(camera.fieldOfView / 2);
  sight.aspect = aspect;
  sight.distance = camera.distance();
  return sight;
}

Ray rayAt(const Camera& camera, double x, double y, double width, double height) {
  const Viewpoint s = sightOf(camera, width / height);
  const double px = (2 * x / width - 1) * s.tanHalf * s.aspect, py = (1 - 2 * y / height) * s.tanHalf;
  return {s.eye, normalized(s.right * px + s.up * py - s.back)};
}

}  // namespace karinui::studio
