#pragma once
// Slash and spread: paper is cut straight from one edge to another and opened, so that the piece gets wider there: a
// flared hem, a fuller sleeve. Or it is folded out along that line, and gets smaller. Metres on paper. Pure; any
// thread.
#include <functional>
#include <string>

#include "karinui/pattern/edit.h"

namespace karinui {

// Places on the outline by shares of an edge's length; a place within 1 mm of a corner is the corner.
struct Slash {
  std::string from, to;         // two edges
  double at = 0.5, toAt = 0.5;  // where the slash begins and ends on them
  double by = 0.03, toBy = 0;   // how wide it opens there, straight across: both alike is parallel, 0 is a hinge
                                // less than nothing: folded out, as much lies double
  bool smooth = true;           // the edges run on in a curve over the opening; no: in straight lines
  bool folded = false;  // what opens is folded in: the first edge runs in straight lines, the other one through a hinge
  bool shared = false;  // of an opening in a corner both edges there get a half, not all of it the named one
  enum class Stays {
    Larger,   // the larger part; the other is moved
    Ahead,    // the part from the slash's beginning on along the outline
    Behind,   // the other
    Neither,  // both are moved by half
  } stays = Stays::Larger;
};
Slash mirrored(const Slash& slash, const std::string& from, const std::string& to);  // on a copy whose edges are these

struct OpenedPiece {
  EditedPiece edited;
  Slash::Stays stays;               // decided
  std::function<Flat(Flat)> place;  // where a place of the paper is now
};
// Edges keep their names; where the slash ends on a sewn edge the seam holds the added length, too. Holes, drill holes
// and lines go with their paper, lines across the slash are led over the opening; the form is stretched beside the
// slash. What is folded out is gone, half of it on either side of the slash. Grain stays. Refuses a slash that leaves
// the piece or meets a hole, and an opening wider than the slash is long.
Result<OpenedPiece> spreadPiece(const Piece& piece, const Slash& slash);

// The part in which one of the edges lies stays; where both have one, or none has, the slash says.
Slash::Stays staying(const Outline& outline, const Slash& slash, const std::function<bool(const std::string&)>& kept);

// Whether two slashes of an outline cross or touch elsewhere than at a hinge that both have.
bool meet(const Outline& outline, const Slash& one, const Slash& other);

}  // namespace karinui
