#pragma once
// ./test --long (KARINUI_LONG=1) runs the same tests for longer.
#include <cstdlib>

namespace karinui {

inline bool atLength() {
  const char* asked = std::getenv("KARINUI_LONG");
  return asked && *asked;
}
// How often a soak is repeated: ten times as often at length.
inline int soak(int usually) { return atLength() ? 10 * usually : usually; }

}  // namespace karinui
