#pragma once
// A piece of our own from the points of a CAD file. Metres on paper. Pure.
#include "cad_style.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// The whole piece: a half on a fold line unfolded, its points joined by curves, notches on their edges. Only the
// style's sample size tells corners from points on a curve; `sample` is the same piece of that size, or null. What is
// left out or guessed is added to `notes`. Without an id; named as the file does.
Result<Piece> pieceOf(const CadPiece& drawn, const CadPiece* sample, std::vector<Message>& notes);

}  // namespace karinui
