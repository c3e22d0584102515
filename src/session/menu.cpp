#include "karinui/session/menu.h"

#include <array>
#include <cmath>

namespace karinui {

namespace {

constexpr std::array kBar{Command::Draw,    Command::Move,        Command::Sew,  Command::Cut,   Command::Pull,
                          Command::Reshape, Command::ViewOblique, Command::Undo, Command::Settle};
constexpr double kNear = 0.62;                             // of the distance to what is looked at
constexpr double kButton = 1.0, kGap = 0.10, kRim = 0.16;  // in buttons
constexpr double kHigh = 1.08;                             // of a button, its word included
constexpr std::size_t kTools = 6;                          // a wider gap after them

std::optional<std::array<double, 2>> placeOn(const ScenePanel& panel, const Ray& ray) {
  const Vec3 normal = cross(panel.across, panel.upward);
  const double slope = dot(normal, ray.direction);
  if (std::fabs(slope) < 1e-12 * length(normal)) return std::nullopt;
  const double along = dot(panel.corner - ray.origin, normal) / slope;
  if (along <= 0) return std::nullopt;
  const Vec3 p = ray.origin + ray.direction * along - panel.corner;
  const double x = dot(p, normalized(panel.across)), y = dot(p, normalized(panel.upward));
  if (x < 0 || y < 0 || x > length(panel.across) || y > length(panel.upward)) return std::nullopt;
  return std::array{x, y};
}

}  // namespace

std::span<const Command> menuBar() { return kBar; }

ScenePanel menuPanel(const Sight& sight, const MenuState& state) {
  const double far = sight.distance * kNear, half = far * sight.tanHalf;
  const double count = kBar.size();
  const double wide = count * kButton + (count - 1) * kGap + 2 * kRim + kGap * 2;
  // A ninth of the view's height a button, or what fits its width.
  const double unit = std::min(half * 2 / 9, half * 2 * sight.aspect * 0.94 / wide);
  ScenePanel panel;
  const Vec3 middle = sight.eye - sight.back * far - sight.up * (half * 0.965 - (kHigh / 2 + kRim) * unit);
  panel.across = sight.right * (wide * unit);
  // Leaning back a little, like a tray.
  const double lean = 0.12;
  panel.upward = normalized(sight.up * std::cos(lean) - sight.back * std::sin(lean)) * ((kHigh + 2 * kRim) * unit);
  panel.corner = middle - panel.across * 0.5 - panel.upward * 0.5;
  double x = kRim;
  for (std::size_t i = 0; i < kBar.size(); ++i) {
    const CommandInfo& about = info(kBar[i]);
    if (i == kTools) x += 2 * kGap;
    ScenePanel::Button button;
    button.left = x * unit;
    button.bottom = kRim * unit;
    button.width = kButton * unit;
    button.height = kHigh * unit;
    button.icon = kBar[i] == Command::ViewOblique ? "view" : std::string(about.icon);
    button.label = kBar[i] == Command::ViewOblique ? say("View") : about.label;
    button.hot = state.hot == kBar[i];
    button.chosen = state.chosen && state.chosen(kBar[i]);
    button.enabled = !state.enabled || state.enabled(kBar[i]);
    panel.buttons.push_back(std::move(button));
    x += kButton + kGap;
  }
  return panel;
}

std::optional<Command> menuHit(const ScenePanel& panel, const Ray& ray) {
  const auto at = placeOn(panel, ray);
  if (!at) return std::nullopt;
  for (std::size_t i = 0; i < panel.buttons.size(); ++i) {
    const ScenePanel::Button& b = panel.buttons[i];
    if ((*at)[0] >= b.left && (*at)[0] <= b.left + b.width && (*at)[1] >= b.bottom && (*at)[1] <= b.bottom + b.height)
      return kBar[i];
  }
  return std::nullopt;
}

bool meets(const ScenePanel& panel, const Ray& ray) { return placeOn(panel, ray).has_value(); }

}  // namespace karinui
