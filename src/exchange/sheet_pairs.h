#pragma once
// Pieces of a sheet that are each other's mirror image in all that is drawn of them: a left and a right. One drawing
// does for both, cut once as it lies and once turned over.
#include <map>

#include "sheet.h"

namespace karinui {

// Of each second piece of a pair the first. All that is drawn on edges and inside is drawn, but no words yet. A piece
// with match marks (`matches`) is cut by its own drawing.
std::map<PieceId, PieceId> secondsOfPairs(const std::vector<SheetPiece>& pieces, const SheetSettings& settings);
// Where a place on the second lies on the first, turned over.
Mm turnedOver(const SheetPiece& second, const SheetPiece& first, Mm place);

}  // namespace karinui
