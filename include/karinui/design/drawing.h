#pragma once
// The two operations that make paper from shapes in space, as functions a gesture can preview with.
// Pure; metres.
#include <optional>
#include <span>

#include "karinui/design/apply.h"
#include "karinui/geometry/fair_points.h"
#include "karinui/geometry/flatten.h"

namespace karinui {

// What a drawn line gives. `piece` has no id yet. `distortion` tells how far cloth is from lying as drawn; `advice`
// says which cut or dart would help where that is more than cloth bears, and which edge wavers.
struct DrawnPiece {
  Piece piece;
  Distortion distortion;
  std::vector<Advice> advice;  // without the piece's id
};
// The operation need not be resolved. Refuses open lines, lines that cross themselves, parts that are no sheet.
Result<DrawnPiece> drawn(const Document& document, const DrawPiece& draw, Context& context);

// How often an edge of a hand-drawn piece turns from one side to the other and back, beyond what a tailor's curve does:
// 0 for a fair line, a curve, an S.
int wavers(const Curve& edge);
// Curves that follow each other as one fair line between the same ends: waves shorter than 18 cm are taken out, and
// longer ones while a curve wavers. Where two curves meet comes along.
std::vector<Curve> fairLine(std::span<const Curve> run, KeptDirections kept = {});

// One place of the cloth taken by the hand, without force.
struct ReshapePull {
  Flat at;  // paper place
  Vec3 by;  // metres in space
};
// The reshape operation for pulls on a piece as it stands: the pulled shape, cloth within `within` coming along, is
// laid flat again. Edges keep their names; what the pulls did not reach stays exactly as it is. A straight edge stays
// straight unless it is pulled between its ends; what is cut anew meets its neighbours at the old angle. `symmetric`: a
// piece whose halves mirror each other is pulled on both (Auto: if it is such a piece); the operation holds all pulls
// and the new outline. No pull gives the old outline.
Result<ReshapePiece> reshaped(const Document& document, PieceId piece, std::span<const ReshapePull> pulls,
                              Length within, Choice symmetric, const Token& token);

}  // namespace karinui
