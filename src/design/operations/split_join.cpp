// Points put on the paper and taken away.
#include <cmath>

#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, SplitEdge& op, Context& context) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (!(op.at > 0 && op.at < 1)) return refused(say("A point lies between 0, the edge's beginning, and 1, its end."));
  const Piece& piece = *before.find(op.edge.piece.id);
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& symmetry) {
    return imageOf(piece.outline, symmetry, {*piece.outline.find(op.edge.edge), op.at}).has_value();
  });
}

Result<Document> perform(const Document& before, const SplitEdge& op, Context&) {
  const Piece& piece = *before.find(op.edge.piece.id);
  const auto split = splitEdge(piece, op.edge.edge, op.at);
  if (!split) return split.error();
  Document after = withEdit(before, *split);
  if (op.symmetric != Choice::Yes) return after;
  const auto image = imageOf(piece.outline, *symmetryOf(piece.outline), {*piece.outline.find(op.edge.edge), op.at});
  const std::string& other = piece.outline.edges[image->edge].name;
  if (other == op.edge.edge && std::fabs(op.at - 0.5) < 1e-6) return after;  // its own image
  const auto there = placeNow(split->edges, piece.id, other, image->at);
  const auto both = splitEdge(*after.find(piece.id), there->first, there->second);
  if (!both) return both.error();
  return withEdit(std::move(after), *both);
}

Done resolve(const Document& before, JoinEdges& op, Context& context) {
  const bool recordOfBefore = op.edge.piece.id && op.symmetric != Choice::Auto;
  if (op.refit == Choice::Auto && !recordOfBefore) op.refit = Choice::Yes;
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  const Piece& piece = *before.find(op.edge.piece.id);
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& symmetry) {
    const std::size_t k = *piece.outline.find(op.edge.edge), next = (k + 1) % piece.outline.edges.size();
    return symmetry.partner[k] && symmetry.partner[next];
  });
}

Result<Document> perform(const Document& before, const JoinEdges& op, Context&) {
  const Piece& piece = *before.find(op.edge.piece.id);
  const bool refit = op.refit == Choice::Yes;
  const auto& edges = piece.outline.edges;
  auto joined = joinEdges(piece, op.edge.edge, refit);
  if (!joined) return joined.error();
  if (op.symmetric != Choice::Yes) return withEdit(before, *joined);
  // The point's image lies where the image of the next edge ends.
  const std::size_t k = *piece.outline.find(op.edge.edge), next = (k + 1) % edges.size();
  const PaperSymmetry symmetry = *symmetryOf(piece.outline);
  const std::size_t other = *symmetry.partner[next];
  const auto curveOf = [](EditedPiece& edited, const std::string& name) -> Curve& {
    return edited.piece.outline.edges[*edited.piece.outline.find(name)].curve;
  };
  if (other == k) {  // on the axis
    if (refit) {
      Curve& curve = curveOf(*joined, edges[k].name);
      const Curve fitted = curve;
      curve = evenAcross(fitted, symmetry);
      curve.start = fitted.start, curve.end = fitted.end;  // where its neighbours end and begin, to the last bit
      if (auto good = checked(joined->piece.outline); !good) return good.error();
    }
    return withEdit(before, *joined);
  }
  Document after = withEdit(before, *joined);
  const std::string& name = edges[other == next ? k : other].name;
  auto both = joinEdges(*after.find(piece.id), name, refit);
  if (!both) return both.error();
  if (refit) {
    Curve& curve = curveOf(*both, name);
    const Curve fitted = curve;
    if (other == next || *symmetry.partner[k] == k)  // all three are one now, across the axis
      curve = evenAcross(fitted, symmetry);
    else  // the very image, not a fit of its own
      curve = symmetry.image(curveOf(*joined, edges[k].name)).reversed();
    curve.start = fitted.start, curve.end = fitted.end;
    if (auto good = checked(both->piece.outline); !good) return good.error();
  }
  return withEdit(std::move(after), *both);
}

}  // namespace karinui
