#pragma once
// A cut along one stretch over a piece. Metres on paper.
#include <set>
#include <string>
#include <vector>

#include "cut_stretches.h"
#include "karinui/pattern/edit.h"
#include "meetings.h"

namespace karinui {

// A hole that a cut goes across, and so becomes a part of the outlines of both pieces.
struct HoleCrossing {
  std::size_t hole = 0;
  double enters = 0, leaves = 0;  // segments of the stretch's line walked, with a fraction
  Meeting in, out;
};

// Crossings in the line's order; any other hole on the way is refused. `keepLeft`: whether the part left of the line
// keeps the id; nothing: the larger.
Result<CutPieces> cutAlong(const Piece& piece, Stretch stretch, std::vector<HoleCrossing> crossings, PieceId second,
                           const std::string& secondName, const std::set<std::string>& sewnLines,
                           std::optional<bool> keepLeft = {});

}  // namespace karinui
