#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, DuplicatePiece& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.name.empty()) op.name = usableName(before, before.find(op.piece.id)->name);
  if (!(length(op.by) <= 100)) return refused(say("A piece is moved by at most {0} m.", 100));
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const DuplicatePiece& op, Context&) {
  Piece copy = *before.find(op.piece.id);
  copy.id = mint<PieceId>(before, 0);
  copy.name = op.name;
  copy.pose.carry += op.by;
  copy.mirrorOf = PieceId();
  Document after = before;
  if (const auto look = before.looks.pieces.find(op.piece.id); look != before.looks.pieces.end())
    after.looks.pieces[copy.id] = look->second;
  return withPiece(std::move(after), std::move(copy));
}

}  // namespace karinui
