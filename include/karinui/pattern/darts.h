#pragma once
// Darts of a pattern: wedges whose two legs are sewn to each other. A narrow one is folded, not cut out: the paper goes
// on across its mouth. Metres on paper. Pure; any thread.
#include <optional>
#include <set>
#include <string_view>
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
std::optional<PaperDart> dartWithLeg(const Pattern& pattern, PieceId piece, std::string_view leg);

// A dart with two points, as in the waist of a shirt or a dress without a waist seam: a hole that one seam closes.
struct DoubleDart {
  SeamId seam;
  PieceId piece;
  std::size_t hole = 0;
  Flat from, to;        // its points
  Flat left, right;     // on its two legs, as walked from one point to the other, where they are farthest apart
  bool folded() const;  // narrow enough
};
std::vector<DoubleDart> doubleDartsOf(const Pattern& pattern);
// The holes of a piece that are marked on its paper, and not cut out.
std::set<std::size_t> foldedHoles(const Pattern& pattern, PieceId piece);

// To which side a sewn dart is pressed: an upright one (waist, shoulder) towards the centre, which is the piece's own
// axis or, of a half, its longest straight upright edge; a level one (bust, elbow) downwards. True: over the edge
// before its mouth; false: over the edge behind it. A mirrored piece's darts are pressed as their mirror images.
bool pressedForward(const Piece& piece, const PaperDart& dart);

// Where the cut across a folded dart's mouth peaks: pressed, the paper ends where the edge that it lies over does.
Flat capOf(const Piece& piece, const PaperDart& dart);

}  // namespace karinui
