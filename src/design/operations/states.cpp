// The small ones: freeze, layer, set, grain.
#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, FreezePieces& op, Context&) { return resolve(before, op.pieces); }

Result<Document> perform(const Document& before, const FreezePieces& op, Context&) {
  Document after = before;
  for (const PieceRef& ref : op.pieces) {
    Piece piece = *after.find(ref.id);
    piece.frozen = op.frozen;
    after.pattern.pieces[ref.id] = std::make_shared<const Piece>(std::move(piece));
  }
  return after;
}

Done resolve(const Document& before, SetLayer& op, Context&) {
  if (op.layer < 0 || op.layer > 20) return refused(say("A layer is a number from 0, next to the skin, to 20."));
  return resolve(before, op.pieces);
}

Result<Document> perform(const Document& before, const SetLayer& op, Context&) {
  Document after = before;
  for (const PieceRef& ref : op.pieces) {
    Piece piece = *after.find(ref.id);
    piece.layer = op.layer;
    after = withPiece(std::move(after), std::move(piece));
  }
  return after;
}

Done resolve(const Document&, ChangeSettings& op, Context&) {
  if (!op.spacing && !op.ease && !op.collider) return refused(say("Say what to set: spacing, ease or collider."));
  if (op.spacing && !(*op.spacing >= 0.002 && *op.spacing <= 0.05)) {
    return refused(say("The threads of the lattice lie between 2 mm and 50 mm apart; 10 mm is usual."));
  }
  if (op.ease && !(*op.ease >= 0 && *op.ease <= 0.5)) {
    return refused(say("The ease lies between 0 and 50 cm; 8 mm is usual."));
  }
  return {};
}

Result<Document> perform(const Document& before, const ChangeSettings& op, Context&) {
  Document after = before;
  if (op.spacing) after.settings.spacing = *op.spacing;
  if (op.ease) after.settings.ease = *op.ease;
  if (op.collider) after.settings.collider = *op.collider;
  if (op.spacing || op.collider) {
    for (const auto& [id, piece] : before.pattern.pieces) after.drape.dirty.insert(id);
  }
  return after;
}

Done resolve(const Document& before, SetGrain& op, Context& context) {
  if (!finite(op.to) || !(length(op.to) > 1e-9)) return refused(say("The grain needs a direction, like to=0,1."));
  if (Done done = resolve(before, op.pieces); !done) return done;
  return resolveCopies(before, op.pieces, op.copies, context);
}

Result<Document> perform(const Document& before, const SetGrain& op, Context&) {
  Document after = before;
  const auto turn = [&](PieceId id, Flat to) {
    Piece piece = *before.find(id);
    piece.grain = normalized(to);
    after = withPiece(std::move(after), std::move(piece));
  };
  std::set<PieceId> turned;  // with the piece it is the copy of, which was named before it
  for (const PieceRef& piece : op.pieces) {
    if (!turned.insert(piece.id).second) continue;
    turn(piece.id, op.to);
    for (const PieceId copy : copiesMeant(before, piece.id, op.copies))
      if (turned.insert(copy).second) turn(copy, {-op.to.u, op.to.v});
  }
  return after;
}

}  // namespace karinui
