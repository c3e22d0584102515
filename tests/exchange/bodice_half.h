#pragma once
// The front half of a bodice with a curved side, armhole and neck. Metres.
#include "karinui/pattern/piece.h"

namespace karinui {

inline Outline bodiceHalf() {
  Outline outline;
  outline.edges = {{"hem", Curve::line({0, 0}, {0.25, 0})},
                   {"side", Curve::cubic({0.25, 0}, {0.22, 0.1}, {0.22, 0.2}, {0.26, 0.3})},
                   {"armhole", Curve::cubic({0.26, 0.3}, {0.16, 0.31}, {0.19, 0.4}, {0.2, 0.5})},
                   {"shoulder", Curve::line({0.2, 0.5}, {0.1, 0.54})},
                   {"neck", Curve::arc({0.1, 0.54}, {0, 0.45}, -0.35)},
                   {"centre", Curve::line({0, 0.45}, {0, 0})}};
  return outline;
}

}  // namespace karinui
