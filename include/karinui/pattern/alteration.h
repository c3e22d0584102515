#pragma once
// An alteration of a piece done to the same piece of another size. Metres on paper. Pure; any thread.
#include "karinui/pattern/piece.h"

namespace karinui {

// What led from `before` to `after`, done to `other`: every corner and control goes as far as its counterpart went.
// Where an edge became a curve of another kind it has the new curve's shape between its own corners. All three name the
// same edges in the same order; refused otherwise, and where what comes out is no outline.
Result<Outline> alteredAlike(const Outline& before, const Outline& after, const Outline& other);

}  // namespace karinui
