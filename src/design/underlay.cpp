#include "karinui/design/underlay.h"

#include <cmath>

#include "karinui/base/message.h"

namespace karinui {

Flat Underlay::inPicture(Flat table) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const Flat from = table - at, laid{c * from.u + s * from.v, c * from.v - s * from.u};
  return {laid.u / pixel() + 0.5 * wide, 0.5 * high - laid.v / pixel()};
}

Flat Underlay::onTable(Flat picture) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const Flat laid{(picture.u - 0.5 * wide) * pixel(), (0.5 * high - picture.v) * pixel()};
  return at + Flat{c * laid.u - s * laid.v, s * laid.u + c * laid.v};
}

bool Underlay::holds(Flat table) const {
  const Flat p = inPicture(table);
  return p.u >= 0 && p.v >= 0 && p.u <= wide && p.v <= high;
}

Done checkUnderlay(const Underlay& underlay) {
  constexpr double kLeast = 0.01, kMost = 20, kFarthest = 100;  // metres
  for (const double side : {underlay.width, underlay.height()})
    if (!(side >= kLeast && side <= kMost))
      return refused(say("A scan would be {0} cm wide or high; between {1} and {2} cm is possible.", side * 100,
                         kLeast * 100, kMost * 100));
  if (!(std::fabs(underlay.at.u) <= kFarthest && std::fabs(underlay.at.v) <= kFarthest))
    return refused(say("A scan would lie farther than {0} m away.", kFarthest));
  if (!(std::fabs(underlay.turn) <= 6.3)) return refused(say("A scan is turned by a full circle at most."));
  if (!(underlay.strength > 0 && underlay.strength <= 1))
    return refused(say("A scan's strength is between 0 (not seen) and 1; hidden=yes hides it."));
  return {};
}

const std::string* underlayAt(const Underlays& underlays, Flat table) {
  const std::string* found = nullptr;
  for (const auto& [name, underlay] : underlays)
    if (!underlay.hidden && underlay.holds(table)) found = &name;
  return found;
}

}  // namespace karinui
