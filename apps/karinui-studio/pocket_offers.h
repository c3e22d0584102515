#pragma once
// Pockets in a seam and slanted ones, as the right button first offers them.
#include <optional>

#include "karinui/design/operation.h"

namespace karinui::studio {

// A pocket in the seam of an upright edge, behind this piece; where it is sewn to one that stands before it, behind
// that one. Nothing where the edge is not sewn, is too short, or is a side of a dart.
std::optional<SewPocket> pocketIn(const Document& document, const EdgeRef& edge);

// A slanted pocket at the upper end of an upright edge; of a level one, at the corner nearer to the place `fraction`.
// Nothing where there is no such corner, or no room.
std::optional<SewPocket> slantedAt(const Document& document, const EdgeRef& edge, double fraction);

// A jetted pocket with its middle at a place of a piece. Nothing where the piece is too small for one.
std::optional<SewWelt> weltAt(const Document& document, PieceId piece, Flat place);

}  // namespace karinui::studio
