// The small ones: freeze, layer, set, grain, notch.
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

Done resolve(const Document& before, SetGrain& op, Context&) {
  if (!finite(op.to) || !(length(op.to) > 1e-9)) return refused(say("The grain needs a direction, like to=0,1."));
  return resolve(before, op.piece);
}

Result<Document> perform(const Document& before, const SetGrain& op, Context&) {
  Piece piece = *before.find(op.piece.id);
  piece.grain = normalized(op.to);
  return withPiece(before, std::move(piece));
}

Done resolve(const Document& before, AddNotch& op, Context&) {
  if (op.edge == EdgeRef() ? !op.point : op.point.has_value()) {
    return refused(say("Say where to mark: edge=front.side at=0.5, or piece=front point=10cm,5cm."));
  }
  if (!op.name.empty()) {
    if (Done done = checkName(op.name); !done) return done;
  }
  if (op.point) {
    if (Done done = resolve(before, op.piece); !done) return done;
    const Piece& piece = *before.find(op.piece.id);
    if (!contains(piece.outline.flattened(1e-4), *op.point)) {
      return refused(say("The drill hole is not on “{0}”.", piece.name));
    }
    return {};
  }
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  op.piece = op.edge.piece;
  if (!(op.at >= 0 && op.at <= 1)) return refused(say("A notch lies between 0, the edge's beginning, and 1, its end."));
  return {};
}

Result<Document> perform(const Document& before, const AddNotch& op, Context&) {
  Document after = before;
  Piece piece = *before.find(op.piece.id);
  Mark mark;
  mark.name = op.name;
  if (op.point) {
    mark.place = *op.point;
  } else {
    mark.edge = op.edge.edge;
    mark.fraction = op.at;
  }
  piece.marks.push_back(std::move(mark));
  after.pattern.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));  // a mark moves no cloth
  return after;
}

}  // namespace karinui
