#pragma once
// A board that hangs before the person while something is to be chosen: its place and its buttons, in one column or
// more. In the stand. Pure; any thread.
#include <vector>

#include "karinui/scene/overlay.h"

namespace karinui::room {

inline constexpr double kBeside = 0.10;      // what it is about stays in sight
inline constexpr double kChoiceWide = 0.62;  // of its distance

struct Choice {
  std::vector<Message> title;
  SceneMenu panel;  // without its buttons until they are put on
};

// With room for so many items, facing eyes that are there, a little nearer than what it is about and beside it.
// `scale`: room metres for a metre of the stand.
// `beside`: from there to its left edge, and `wide`: how wide it is, as shares of the distance to it.
Choice choiceBefore(Vec3 eyes, Vec3 about, double scale, std::size_t items, std::size_t columns,
                    double beside = kBeside, double wide = kChoiceWide);
// The button of one of so many items, column by column from the top.
SceneMenu::Button buttonOn(const SceneMenu& panel, std::size_t item, std::size_t items, std::size_t columns);

}  // namespace karinui::room
