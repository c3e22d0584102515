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
  if (before.grading.pieces.contains(fold.piece.id) && before.grading.standing != before.grading.base)
    return refused(
        say("Unfold in the base size: choose it first, size name={0}.", before.grading.sizes[before.grading.base]));
  return {};
}

namespace {

// The half was graded: the differences of the whole are measured between the halves of all sizes, unfolded.
Done gradeWhole(const Document& before, Document& after, const EdgeRef& fold) {
  const PieceId id = fold.piece.id;
  if (!before.grading.pieces.contains(id)) return {};
  std::vector<Outline> sizes;
  for (std::size_t size = 0; size < before.grading.sizes.size(); ++size) {
    const auto half = inSize(*before.find(id), before.grading, size);
    const auto whole = half ? unfolded(*half, fold.edge) : Result<EditedPiece>(half.error());
    if (!whole) return refused(say("In size {0}: {1}", before.grading.sizes[size], whole.error().what));
    sizes.push_back(whole->piece.outline);
  }
  auto measured = measuredGrading(sizes, before.grading.base);
  if (!measured) return measured.error();
  after.grading.pieces[id] = *std::move(measured);
  return {};
}

}  // namespace

Result<Document> perform(const Document& before, const UnfoldPiece& op, Context&) {
  const auto whole = unfolded(*before.find(op.edge.piece.id), op.edge.edge);
  if (!whole) return whole.error();
  Document after = withEdit(before, *whole);
  if (Done done = gradeWhole(before, after, op.edge); !done) return done.error();
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
