#pragma once
// A piece of our own from the points of a CAD file. Metres on paper. Pure.
#include "cad_style.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// How a piece's edges were made out of its points; the other sizes' are made alike, though their corners are blunter.
struct EdgePlan {
  std::size_t begin = 0;             // of the runs of points between turns, the one the first edge starts with
  std::vector<char> corner, joined;  // runs that start an edge; edges too short, which were given to the one before
  std::vector<std::pair<Flat, std::size_t>> rules;  // grade rules at places of the outline,
  std::vector<Flat> folds;                          // and for each the fold it was mirrored on, or (0, 0)
};

// The whole piece: a half on a fold line unfolded, its points joined by curves, notches on their edges. Only the
// style's sample size tells corners from points on a curve; `sample` is the same piece of that size, or null. What is
// left out or guessed is added to `notes`. Without an id; named as the file does.
Result<Piece> pieceOf(const CadPiece& drawn, const CadPiece* sample, std::vector<Message>& notes, EdgePlan& plan);
// The same piece's outline in another size.
Result<Outline> outlineOf(const CadPiece& drawn, const CadPiece* sample, const EdgePlan& plan);

struct PlaceOnOutline {
  std::string edge;
  double fraction = 0, distance = 1e9;
};
PlaceOnOutline nearestOn(const Outline& outline, Flat place);

}  // namespace karinui
