// Points put on the paper and taken away.
#include <cmath>

#include "design/operations/operations.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

Done resolve(const Document& before, SplitEdge& op, Context&) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (!(op.at > 0 && op.at < 1)) return refused(say("A point lies between 0, the edge's beginning, and 1, its end."));
  return resolveSymmetric(*before.find(op.edge.piece.id), op.symmetric);
}

Result<Document> perform(const Document& before, const SplitEdge& op, Context&) {
  const Piece& piece = *before.find(op.edge.piece.id);
  const auto split = splitEdge(piece, op.edge.edge, op.at);
  if (!split) return split.error();
  Document after = withEdit(before, *split);
  if (op.symmetric != Choice::Yes) return after;
  const std::size_t partner = symmetryOf(piece.outline)->partner[*piece.outline.find(op.edge.edge)];
  const std::string& other = piece.outline.edges[partner].name;
  if (other == op.edge.edge && std::fabs(op.at - 0.5) < 1e-6) return after;  // its own image
  const auto there = placeNow(split->edges, piece.id, other, 1 - op.at);
  const auto both = splitEdge(*after.find(piece.id), there->first, there->second);
  if (!both) return both.error();
  return withEdit(std::move(after), *both);
}

Done resolve(const Document& before, JoinEdges& op, Context&) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  return resolveSymmetric(*before.find(op.edge.piece.id), op.symmetric);
}

Result<Document> perform(const Document& before, const JoinEdges& op, Context&) {
  const Piece& piece = *before.find(op.edge.piece.id);
  const auto joined = joinEdges(piece, op.edge.edge);
  if (!joined) return joined.error();
  Document after = withEdit(before, *joined);
  if (op.symmetric != Choice::Yes) return after;
  // The point's image lies where the image of the next edge ends.
  const auto& edges = piece.outline.edges;
  const std::size_t k = *piece.outline.find(op.edge.edge), next = (k + 1) % edges.size();
  const std::size_t other = symmetryOf(piece.outline)->partner[next];
  if (other == k) return after;  // on the axis
  const auto both = joinEdges(*after.find(piece.id), edges[other == next ? k : other].name);
  if (!both) return both.error();
  return withEdit(std::move(after), *both);
}

}  // namespace karinui
