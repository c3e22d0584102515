#include "design/operations/copied_joins.h"

namespace karinui {

Done resolve(const Document& before, MirrorPiece& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  decideSeamsWithin(before, op.piece.id, op.seams, context);
  if (op.name.empty()) op.name = nameOfCopy(before, before.find(op.piece.id)->name);
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const MirrorPiece& op, Context& context) {
  Piece copy = mirrored(*before.find(op.piece.id));
  copy.id = mint<PieceId>(before, 0);
  copy.name = op.name;
  copy.mirrorOf = op.piece.id;
  Document after = before;
  if (const auto own = before.grading.pieces.find(op.piece.id); own != before.grading.pieces.end())
    after.grading.pieces[copy.id] = mirroredGrading(own->second, before.find(op.piece.id)->outline, copy.outline);
  copyAllowances(after.allowances, *before.find(op.piece.id), copy, true);
  const PieceId id = copy.id;
  after = withPiece(std::move(after), std::move(copy));
  std::map<PieceId, PieceId> copies;  // what it is fastened to may have a mirror image, too
  for (const auto& [own, piece] : before.pattern.pieces)
    if (before.find(piece->mirrorOf)) copies[own] = piece->mirrorOf, copies[piece->mirrorOf] = own;
  copies[op.piece.id] = id;
  if (op.seams == Choice::Yes) after = withCopiedSeams(std::move(after), op.piece.id, id, true);
  return withCopiedFastenings(std::move(after), op.piece.id, copies, true, context);
}

}  // namespace karinui
