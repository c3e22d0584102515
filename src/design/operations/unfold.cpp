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
  Document after = withEdit(before, *whole);
  // The other half has what the half has.
  const PieceId id = op.edge.piece.id;
  const auto& edges = after.find(id)->outline.edges;
  const std::size_t half = edges.size() / 2;  // the half's own come first
  Piece own = *after.find(id), image = own;
  own.outline.edges.resize(half);
  image.outline.edges.erase(image.outline.edges.begin(),
                            image.outline.edges.begin() + static_cast<std::ptrdiff_t>(half));
  const auto first = after.allowances.corners.find({id, edges[0].name});
  const bool atFold = first != after.allowances.corners.end();
  copyAllowances(after.allowances, own, image, true);
  // Where the halves meet at the fold there is one corner, not one of each.
  if (atFold) after.allowances.corners.erase({id, image.outline.edges[0].name});
  return after;
}

}  // namespace karinui
