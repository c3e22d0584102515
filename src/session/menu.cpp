#include "karinui/session/menu.h"

#include <array>
#include <cmath>

namespace karinui {

namespace {

constexpr std::array kBar{Command::Draw,    Command::Move,        Command::Sew,  Command::Cut,   Command::Pull,
                          Command::Reshape, Command::ViewOblique, Command::Undo, Command::Settle};
constexpr double kNear = 0.62;  // of the distance to what is looked at
constexpr double kHigh = 1.08;  // of a button's width, its label included; the rest is in buttons, too
constexpr double kGap = 0.06, kRim = 0.12, kMargin = 0.14;
constexpr std::size_t kTools = 6;                        // a wider gap after them
constexpr double kMostHigh = 0.94, kMostWide = 1 / 6.0;  // of the view
constexpr double kButtonMost = 0.09;                     // of the view's height,
constexpr double kButtonPoints = 52;                     // and in device-independent pixels

constexpr double kWide = 1 + 2 * kRim;
constexpr double kTall = kBar.size() * kHigh + (kBar.size() + 1) * kGap + 2 * kRim;

// The side of a button, of half the view's height.
double buttonOf(const Sight& sight) {
  const double most = sight.points > 0 ? std::min(kButtonMost, kButtonPoints / sight.points) : kButtonMost;
  return 2 * std::min({kMostHigh / kTall, kMostWide * sight.aspect / kWide, most});
}

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

double menuShare(const Sight& sight) { return (kWide + 2 * kMargin) * buttonOf(sight) / (2 * sight.aspect); }

ScenePanel menuPanel(const Sight& sight, const MenuState& state) {
  const double far = sight.distance * kNear, half = far * sight.tanHalf, unit = half * buttonOf(sight);
  ScenePanel panel;
  panel.across = sight.right * (kWide * unit);
  panel.upward = sight.up * (kTall * unit);
  const Vec3 middle = sight.eye - sight.back * far + sight.right * (half * sight.aspect - (kMargin + kWide / 2) * unit);
  panel.corner = middle - panel.across * 0.5 - panel.upward * 0.5;
  double top = kTall - kRim;
  for (std::size_t i = 0; i < kBar.size(); ++i) {
    const CommandInfo& about = info(kBar[i]);
    if (i == kTools) top -= 2 * kGap;
    ScenePanel::Button button;
    button.left = kRim * unit;
    button.bottom = (top - kHigh) * unit;
    button.width = unit;
    button.height = kHigh * unit;
    button.icon = kBar[i] == Command::ViewOblique ? "view" : std::string(about.icon);
    button.label = kBar[i] == Command::ViewOblique ? say("View") : about.label;
    button.hot = state.hot == kBar[i];
    button.chosen = state.chosen && state.chosen(kBar[i]);
    button.enabled = !state.enabled || state.enabled(kBar[i]);
    panel.buttons.push_back(std::move(button));
    top -= kHigh + kGap;
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
