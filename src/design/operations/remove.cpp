#include <algorithm>

#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, RemovePieces& op, Context&) { return resolve(before, op.pieces); }

Result<Document> perform(const Document& before, const RemovePieces& op, Context&) {
  Document after = before;
  std::set<PieceId> gone;
  for (const PieceRef& ref : op.pieces) {
    gone.insert(ref.id);
    after.pattern.pieces.erase(ref.id);
    after.pins.erase(ref.id);
    after.looks.pieces.erase(ref.id);
    after.looks.shifts.erase(ref.id);
  }
  const auto takeOut = [&](const auto& all, auto& from) {
    for (const auto& [id, sewn] : all) {
      bool touched = false;
      for (const auto* side : {&sewn.a, &sewn.b})
        for (const EdgeSpan& span : *side) touched = touched || gone.contains(span.piece);
      if (!touched) continue;
      for (const auto* side : {&sewn.a, &sewn.b})
        for (const EdgeSpan& span : *side) after.drape.dirty.insert(span.piece);
      from.erase(id);
    }
  };
  takeOut(before.pattern.seams, after.pattern.seams);
  takeOut(before.allowances.fastenings, after.allowances.fastenings);
  updateAllowances(after.allowances, {}, after.pattern);
  for (const PieceId id : gone) after.drape.dirty.erase(id);
  for (auto& [id, shared] : after.pattern.pieces) {
    if (!gone.contains(shared->mirrorOf)) continue;
    Piece piece = *shared;
    piece.mirrorOf = PieceId();
    shared = std::make_shared<const Piece>(std::move(piece));
  }
  return after;
}

}  // namespace karinui
