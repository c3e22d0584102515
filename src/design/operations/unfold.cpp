#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, UnfoldPiece& op, Context&) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  const EdgeRef fold = op.edge;
  for (const auto& [id, seam] : before.pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (span.piece == fold.piece.id && span.edge == fold.edge)
          return refused(say("“{0}” is sewn; a fold lies inside the piece. Take its seam out first.", fold.edge));
  return {};
}

Result<Document> perform(const Document& before, const UnfoldPiece& op, Context&) {
  const auto whole = unfolded(*before.find(op.edge.piece.id), op.edge.edge);
  if (!whole) return whole.error();
  return withEdit(before, *whole);
}

}  // namespace karinui
