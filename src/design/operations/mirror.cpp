#include "design/operations/copied_joins.h"
#include "design/spoken.h"

namespace karinui {

Done resolve(const Document& before, MirrorPiece& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  decideSeamsWithin(before, op.piece.id, op.seams, context);
  if (op.name.empty()) op.name = nameOfCopy(before, before.find(op.piece.id)->name);
  return checkNewName(before, op.name);
}

namespace {

// With what sews the copy to others, if it is to be; else it is told that there is such.
Document sewnLikewise(Document document, const MirrorPiece& op, PieceId copy, const Context& context) {
  const std::string name = document.find(op.piece.id)->name;
  const std::size_t made = op.seams == Choice::Yes ? ownSeams(document, op.piece.id).size() : 0;
  MirroredSeams likewise = withMirroredSeams(document, op.piece.id, copy, made);
  if (!op.sewn) {
    if (context.advise && likewise.sewn > 0)
      context.advise(
          {say("“{0}” is not sewn to other pieces, as “{1}” is; sewn=yes does that, too.", op.name, name), copy});
    return document;
  }
  if (context.advise)
    for (const SeamId id : likewise.left)
      context.advise(
          {say("Seam {0} is on the side of “{1}” alone: what it is sewn to there has no mirror image, or one that "
               "is sewn already.",
               spoken(*document.find(id)), name),
           copy});
  return std::move(likewise.document);
}

}  // namespace

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
  after = sewnLikewise(std::move(after), op, id, context);
  return withCopiedFastenings(std::move(after), op.piece.id, copies, true, context);
}

}  // namespace karinui
