#pragma once
// The shape of what is turned back along a straight line, as a cuff is: where a piece narrows towards the line, what
// lies beyond it has to widen again by as much, or it is too tight for what it comes to lie on. Pure; any thread.
// Metres on paper.
#include <functional>
#include <string>

#include "karinui/pattern/edit.h"

namespace karinui {

// The outline beyond an inner line from edge to edge, `beyond` telling by a place which side that is: both its sides
// become the mirror image of the sides before the line, as deep as they were, and its end is fitted between them. The
// edges that go on beyond the line are divided there. Refuses a line that is curved, what has no two sides and an end,
// and what is deeper than the piece before the line.
struct Flared {
  EditedPiece edited;
  double wider = 0;  // at the end; negative: it had been wider than what it comes to lie on
};
Result<Flared> flaredBeyond(const Piece& piece, const std::string& line, const std::function<bool(Flat)>& beyond);

}  // namespace karinui
