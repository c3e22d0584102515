#pragma once
// The house's line icons, as strokes on a square of 24 by 24 (y downwards): one drawing for tool bars on any screen and
// for the floating menu. Plain values that last as long as the program; any thread.
#include <span>
#include <string_view>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

struct IconStroke {
  std::vector<Flat> points;
  bool filled = false;
};
struct Icon {
  std::string_view name;
  std::vector<IconStroke> strokes;
};
const Icon* icon(std::string_view name);  // null: there is none of this name
std::span<const Icon> icons();

}  // namespace karinui
