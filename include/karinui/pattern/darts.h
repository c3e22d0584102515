#pragma once
// Darts of a pattern: wedges whose two legs are sewn to each other. A narrow one is folded, not cut out: the paper goes
// on across its mouth. Metres on paper. Pure; any thread.
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct PaperDart {
  SeamId seam;
  PieceId piece;
  std::size_t to = 0, back = 0;  // of the outline's edges: the leg to the point, and the next one, away from it
  Flat from, point, until;       // the mouth's two ends and the point between
  bool folded() const;           // narrow enough
};
std::vector<PaperDart> dartsOf(const Pattern& pattern);

// To which side a sewn dart is pressed: an upright one (waist, shoulder) towards the centre, which is the piece's own
// axis or, of a half, its longest straight upright edge; a level one (bust, elbow) downwards. True: over the edge
// before its mouth; false: over the edge behind it. A mirrored piece's darts are pressed as their mirror images.
bool pressedForward(const Piece& piece, const PaperDart& dart);

// Where the cut across a folded dart's mouth peaks: pressed, the paper ends where the edge that it lies over does.
Flat capOf(const Piece& piece, const PaperDart& dart);

}  // namespace karinui
