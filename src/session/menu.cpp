#include "karinui/session/menu.h"

#include <array>
#include <cmath>
#include <vector>

namespace karinui {

namespace {

const std::vector<Command>& bar() {
  static const std::vector<Command> on = [] {
    std::vector<Command> found;
    for (const CommandInfo& one : commands())
      if (one.onBar) found.push_back(one.command);
    return found;
  }();
  return on;
}
constexpr double kBoardNear = 0.62;  // of the distance to what is looked at
constexpr double kHigh = 1.08;       // of a button's width, its label included; the rest is in buttons, too
constexpr double kGap = 0.06, kRim = 0.12, kMargin = 0.14;
constexpr double kMostHigh = 0.94, kMostWide = 1 / 6.0;  // of the view
constexpr double kButtonMost = 0.09;                     // of the view's height,
constexpr double kButtonPoints = 52;                     // and in device-independent pixels

constexpr double kWide = 1 + 2 * kRim;
double tall() {
  const auto buttons = static_cast<double>(bar().size());
  return buttons * kHigh + (buttons + 1) * kGap + 2 * kRim;
}

// The side of a button, of half the view's height.
double buttonOf(const Viewpoint& viewpoint) {
  const double most = viewpoint.points > 0 ? std::min(kButtonMost, kButtonPoints / viewpoint.points) : kButtonMost;
  return 2 * std::min({kMostHigh / tall(), kMostWide * viewpoint.aspect / kWide, most});
}

std::optional<std::array<double, 2>> placeOn(const SceneMenu& panel, const Ray& ray) {
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

std::span<const Command> menuBar() { return bar(); }

double menuShare(const Viewpoint& viewpoint) {
  return (kWide + 2 * kMargin) * buttonOf(viewpoint) / (2 * viewpoint.aspect);
}

SceneMenu menuPanel(const Viewpoint& viewpoint, const MenuState& state) {
  const double far = viewpoint.distance * kBoardNear, half = far * viewpoint.tanHalf, unit = half * buttonOf(viewpoint);
  SceneMenu panel;
  panel.across = viewpoint.right * (kWide * unit);
  panel.upward = viewpoint.up * (tall() * unit);
  const Vec3 middle =
      viewpoint.eye - viewpoint.back * far + viewpoint.right * (half * viewpoint.aspect - (kMargin + kWide / 2) * unit);
  panel.corner = middle - panel.across * 0.5 - panel.upward * 0.5;
  double top = tall() - kRim;
  for (std::size_t i = 0; i < bar().size(); ++i) {
    const CommandInfo& about = info(bar()[i]);
    if (i > 0 && !isTool(bar()[i]) && isTool(bar()[i - 1])) top -= 2 * kGap;
    SceneMenu::Button button;
    button.left = kRim * unit;
    button.bottom = (top - kHigh) * unit;
    button.width = unit;
    button.height = kHigh * unit;
    button.icon = bar()[i] == Command::ViewOblique ? "view" : std::string(about.icon);
    button.label = bar()[i] == Command::ViewOblique ? say("View") : about.label;
    button.hot = state.hot == bar()[i];
    button.chosen = state.chosen && state.chosen(bar()[i]);
    button.enabled = !state.enabled || state.enabled(bar()[i]);
    panel.buttons.push_back(std::move(button));
    top -= kHigh + kGap;
  }
  return panel;
}

std::optional<Command> menuHit(const SceneMenu& panel, const Ray& ray) {
  const auto at = placeOn(panel, ray);
  if (!at) return std::nullopt;
  for (std::size_t i = 0; i < panel.buttons.size(); ++i) {
    const SceneMenu::Button& b = panel.buttons[i];
    if ((*at)[0] >= b.left && (*at)[0] <= b.left + b.width && (*at)[1] >= b.bottom && (*at)[1] <= b.bottom + b.height)
      return bar()[i];
  }
  return std::nullopt;
}

bool meets(const SceneMenu& panel, const Ray& ray) { return placeOn(panel, ray).has_value(); }

}  // namespace karinui
