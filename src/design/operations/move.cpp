#include "design/operations/operations.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

namespace {

constexpr double kFarthest = 100;  // metres: beyond a workroom nobody means it

Flat middle(const Piece& piece) {
  const FlatBox box = boxOf(piece.outline.flattened(1e-3));
  return lerp(box.low, box.high, 0.5);
}

}  // namespace

Done resolve(const Document& before, MovePiece& op, Context&) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (length(op.by) == 0 && !(op.turn && op.turn->angle != 0))
    return refused(say("Say how far the piece goes (by=10cm,0,0) or how it turns (turn=\"y 90deg\")."));
  if (!(length(op.by) <= kFarthest)) return refused(say("A piece is moved by at most {0} m.", kFarthest));
  if (op.turn && !(std::abs(op.turn->angle) <= 1000)) return refused(say("That turn is too large."));
  // The middle is an average of the paper, so the record says it: reshaping an earlier step then keeps the same place.
  if (op.turn && !op.about) op.about = middle(*before.find(op.pieces.front().id));
  return {};
}

Result<Document> perform(const Document& before, const MovePiece& op, Context&) {
  Rigid step;
  if (op.turn) {
    const Vec3 about = Stand(*before.find(op.pieces.front().id))(*op.about);
    step = turnAbout(op.turn->axis, op.turn->angle);
    step.carry = about - step.turned(about);
  }
  step.carry += op.by;
  Document after = before;
  for (const PieceRef& ref : op.pieces) {
    Piece piece = *before.find(ref.id);
    piece.pose = karinui::after(step, piece.pose);
    if (!(length(piece.pose.carry) <= 10 * kFarthest)) {
      return refused(say("“{0}” would be moved out of the room.", piece.name));
    }
    after = withPiece(std::move(after), std::move(piece));
  }
  return after;
}

}  // namespace karinui
