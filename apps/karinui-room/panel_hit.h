#pragma once
// What a pointer meets of a board with buttons: a ray from either side, or a fingertip on the board. Pure; any thread.
#include <optional>

#include "karinui/scene/overlay.h"
#include "karinui/scene/pointer.h"

namespace karinui::room {

struct PanelHit {
  double along = 0;                   // metres of the ray; of a tip 0
  std::optional<std::size_t> button;  // none: the board beside them
};
// Nothing where the board is not met. `sample`: in the panel's own space.
std::optional<PanelHit> hitOf(const SceneMenu& panel, const PointerSample& sample);

}  // namespace karinui::room
