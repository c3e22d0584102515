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

// Where the cut across a folded dart's mouth peaks: folded over the edge behind it, the paper ends where that does.
Flat capOf(const Outline& outline, const PaperDart& dart);

}  // namespace karinui
