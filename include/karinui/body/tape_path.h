#pragma once
// Where each measure is taken on a figure: the tape's way, for a drawing, and how it is taken in words. Made from the
// measure's definition (docs/user/body.md), not drawn by hand. Pure; any thread. Metres.
#include <string_view>
#include <vector>

#include "karinui/body/body.h"

namespace karinui {

struct TapePath {
  std::vector<Vec3> points;
  bool closed = false;
  bool beside = false;  // a height: measured in the air beside the figure, not along the skin
};
std::vector<TapePath> tapePath(const Body& body, std::string_view key);  // empty: cannot be shown on this body
Message tapeSaid(std::string_view key);                                  // empty: no such measure

}  // namespace karinui
