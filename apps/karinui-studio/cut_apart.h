#pragma once
// What a cut parted, as the right button first offers to sew it again.
#include <optional>

#include "karinui/design/operation.h"

namespace karinui::studio {

// The seam that joins an edge along a cut, and those that go on from it, to the edges on the other side of the cut:
// they lie in one place of the paper and run against each other. On the garment's other half too, where that was cut
// likewise. Nothing for an edge that is sewn, and where no such edge is free.
std::optional<SewEdges> sewnAgain(const Document& document, const EdgeRef& edge);

}  // namespace karinui::studio
