#pragma once
// What fastens an edge, as the right button first offers it.
#include <optional>

#include "karinui/session/garment_snapshot.h"

namespace karinui::studio {

// The edge's own mirror image: on the symmetric copy of its piece, or on the other half of that.
std::optional<EdgeRef> twinOf(const Document& document, const EdgeRef& edge);

// Buttons down an edge that lies over and its twin: those of fronts that meet in the middle, sewn there or not, or of
// the ends of a collar. Nothing for other edges, and for one that is fastened already.
std::optional<Fasten> buttonsAt(const GarmentSnapshot& snapshot, const EdgeRef& over);

// Whether a fly belongs there: in the middle of the front, from the waist down. Without a figure any middle seam is
// one.
bool flyFits(const GarmentSnapshot& snapshot, const SewFly& fly);

}  // namespace karinui::studio
