#pragma once
// Which end of an edge stays when its length is typed. Pure; any thread.
#include "karinui/design/document.h"
#include "karinui/design/operation.h"

namespace karinui {

// What SetLength::Keep::Auto comes to: an edge across the centre of a symmetric piece is kept in the middle; an end on
// the centre stays unless it can slide along it; where the edges at its ends are sewn to each other, as a sleeve's at
// its hem, both ends move, so that they stay alike; else the end stays whose neighbour is sewn, else the higher one as
// the cloth stands. `symmetric`: both halves are changed. The edge is one of the piece's outline.
SetLength::Keep keptEnd(const Document& document, const Piece& piece, const std::string& edge, bool symmetric);

}  // namespace karinui
