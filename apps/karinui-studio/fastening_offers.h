#pragma once
// What fastens an edge, as the right button first offers it.
#include <optional>

#include "karinui/session/garment_snapshot.h"

namespace karinui::studio {

// The edge's own mirror image: on the symmetric copy of its piece, or on the other half of that.
std::optional<EdgeRef> twinOf(const Document& document, const EdgeRef& edge);

// Whether a fly belongs there: in the middle of the front, from the waist down. Without a figure any middle seam is
// one.
bool flyFits(const GarmentSnapshot& snapshot, const SewFly& fly);

}  // namespace karinui::studio
