#include "design/operations/operations.h"
#include "design/operations/seam_parts.h"

namespace karinui {

namespace {

using Gone = std::set<PieceId>;

OnSpan on(const Gone& gone) {
  return [&gone](const EdgeSpan& span) { return gone.contains(span.piece); };
}

}  // namespace

Done resolve(const Document& before, RemovePieces& op, Context& context) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (op.seams != Choice::Auto || context.recorded) return {};
  Gone gone;
  for (const PieceRef& ref : op.pieces) gone.insert(ref.id);
  // Said where it matters only.
  for (const auto& [id, seam] : before.pattern.seams)
    if (touches(seam, on(gone)) && !partsWithout(before.pattern, seam, on(gone)).empty()) op.seams = Choice::Yes;
  return {};
}

Result<Document> perform(const Document& before, const RemovePieces& op, Context&) {
  Document after = before;
  Gone gone;
  for (const PieceRef& ref : op.pieces) {
    gone.insert(ref.id);
    after.pattern.pieces.erase(ref.id);
    after.pins.erase(ref.id);
    after.looks.pieces.erase(ref.id);
    after.looks.shifts.erase(ref.id);
  }
  const auto takeOut = [&](const auto& all, auto& from) {
    for (const auto& [id, sewn] : all) {
      if (!touches(sewn, on(gone))) continue;
      for (const auto* side : {&sewn.a, &sewn.b})
        for (const EdgeSpan& span : *side) after.drape.dirty.insert(span.piece);
      from.erase(id);
    }
  };
  takeOut(before.pattern.seams, after.pattern.seams);
  takeOut(before.allowances.fastenings, after.allowances.fastenings);
  std::uint32_t minted = 0;
  if (op.seams == Choice::Yes) keepParts(before, after, on(gone), minted);
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
