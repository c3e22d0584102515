#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, MirrorPiece& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.name.empty()) {
    const std::string& own = before.find(op.piece.id)->name;
    const std::string other = otherSide(own);
    op.name = usableName(before, other == own ? own + "_mirrored" : other);
  }
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const MirrorPiece& op, Context&) {
  Piece copy = mirrored(*before.find(op.piece.id));
  copy.id = mint<PieceId>(before, 0);
  copy.name = op.name;
  copy.mirrorOf = op.piece.id;
  Document after = before;
  if (const auto own = before.grading.pieces.find(op.piece.id); own != before.grading.pieces.end())
    after.grading.pieces[copy.id] = mirroredGrading(own->second, before.find(op.piece.id)->outline, copy.outline);
  copyAllowances(after.allowances, *before.find(op.piece.id), copy, true);
  return withPiece(std::move(after), std::move(copy));
}

}  // namespace karinui
