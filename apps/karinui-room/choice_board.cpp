#include "choice_board.h"

#include <algorithm>

namespace karinui::room {

namespace {

constexpr double kNear = 0.8;    // of the way to what it is about
constexpr double kHigh = 0.055;  // of its distance: an item

double rowsOf(std::size_t items, std::size_t columns) {
  return static_cast<double>(std::max<std::size_t>(1, (items + columns - 1) / columns));
}

}  // namespace

Choice choiceBefore(Vec3 eyes, Vec3 about, double scale, std::size_t items, std::size_t columns, double beside,
                    double wide) {
  const Vec3 way = about - eyes;
  const double near = kNear * std::clamp(length(way), 0.3 / scale, 2.5 / scale);
  const Vec3 ahead = normalized(way), right = normalized(cross(ahead, Vec3{0, 1, 0})), up = cross(right, ahead);
  Choice choice;
  choice.panel.across = right * (near * wide);
  choice.panel.upward = up * (near * kHigh * rowsOf(items, columns));
  choice.panel.corner = eyes + ahead * near + right * (beside * near) - choice.panel.upward * 0.5;
  return choice;
}

SceneMenu::Button buttonOn(const SceneMenu& panel, std::size_t item, std::size_t items, std::size_t columns) {
  const auto rows = static_cast<std::size_t>(rowsOf(items, columns));
  const double wide = length(panel.across) / static_cast<double>(columns);
  const double unit = length(panel.upward) / static_cast<double>(rows);
  SceneMenu::Button button;
  button.left = wide * (static_cast<double>(item / rows) + 0.02), button.width = wide * 0.96;
  button.bottom = unit * (static_cast<double>(rows - 1 - item % rows) + 0.04), button.height = unit * 0.92;
  return button;
}

}  // namespace karinui::room
