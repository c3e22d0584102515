#pragma once
// Which sides of the cloth face alike through the seams that are there. Pure; any thread.
#include <optional>

#include "karinui/design/operation.h"

namespace karinui {

// Whether side b of this seam runs against its own direction, told by the seams that hold its pieces together already:
// cloth has two sides, and a round of seams leads from the right side back to the right side. Nothing where they do not
// hang together yet, where what holds them is no outline, or where they are twisted already.
std::optional<bool> reversedBySides(const Document& document, const SewEdges& sew);

}  // namespace karinui
