#pragma once
// A drawn pleat whose lines meet in a point outside the piece, or where they end: it takes a wedge of the paper, as
// slashing and spreading puts one in. Folded, the cloth beyond it is turned about that point.
#include <array>

#include "karinui/pattern/pleats.h"

namespace karinui {

// The ends of one of the three lines: at the pleated edge and beyond.
struct PleatLine {
  Flat near, far;
};

// `bare`: the piece without the three lines; of fold, inner fold and place. The paper has the cloth already and stays
// where it is: only what ends between the lines is cut anew.
Result<PleatedPiece> foldWedge(const Piece& bare, const DrawnPleat& drawn, const std::array<PleatLine, 3>& lines);

}  // namespace karinui
