#pragma once
// The floating bar as data: what is on it, where it hangs, and what a ray meets. One hit test for mouse, controller and
// stylus. Pure; any thread.
#include <functional>
#include <optional>
#include <span>

#include "karinui/scene/overlay.h"
#include "karinui/scene/pointer.h"
#include "karinui/session/command.h"

namespace karinui {

std::span<const Command> menuBar();

struct MenuState {
  std::function<bool(Command)> enabled, chosen;
  std::optional<Command> hot;
};
// The bar as it hangs before someone who looks from there: a column at the right edge of the view, a little nearer than
// what is looked at, facing the eye. Its size is that of the view, so that it reads alike however far one stands.
SceneMenu menuPanel(const Viewpoint& viewpoint, const MenuState& state);
// The share of the view's width the bar takes at the right edge, its margins included: less than a fourth.
double menuShare(const Viewpoint& viewpoint);

// The button a ray meets, from either side; nothing beside them.
std::optional<Command> menuHit(const SceneMenu& panel, const Ray& ray);
bool meets(const SceneMenu& panel, const Ray& ray);  // the board itself

}  // namespace karinui
