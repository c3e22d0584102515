#include "panel_hit.h"

#include <cmath>

namespace karinui::room {

std::optional<PanelHit> hitOf(const SceneMenu& panel, const PointerSample& sample) {
  const Vec3 normal = normalized(cross(panel.across, panel.upward));
  PanelHit hit;
  Vec3 at;
  if (sample.tip) {
    at = sample.tip->carry;
    if (std::fabs(dot(at - panel.corner, normal)) > sample.reach) return std::nullopt;
  } else {
    const double slope = dot(normal, sample.ray.direction);
    if (std::fabs(slope) < 1e-9) return std::nullopt;
    hit.along = dot(panel.corner - sample.ray.origin, normal) / slope;
    if (hit.along <= 0) return std::nullopt;
    at = sample.ray.origin + sample.ray.direction * hit.along;
  }
  const double x = dot(at - panel.corner, normalized(panel.across)),
               y = dot(at - panel.corner, normalized(panel.upward));
  if (x < 0 || y < 0 || x > length(panel.across) || y > length(panel.upward)) return std::nullopt;
  for (std::size_t i = 0; i < panel.buttons.size(); ++i) {
    const SceneMenu::Button& b = panel.buttons[i];
    if (x >= b.left && x <= b.left + b.width && y >= b.bottom && y <= b.bottom + b.height) hit.button = i;
  }
  return hit;
}

}  // namespace karinui::room
