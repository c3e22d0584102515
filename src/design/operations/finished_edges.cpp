#include "design/operations/finished_edges.h"

namespace karinui {

std::vector<FinishedEdge> finishedEdges(const Document& document, const std::vector<EdgeRef>& named, bool bothHalves) {
  std::vector<FinishedEdge> all;
  for (const EdgeRef& ref : named) {
    const Piece& piece = *document.find(ref.piece.id);
    const std::size_t edge = *piece.outline.find(ref.edge);
    all.push_back({piece.id, edge, false});
    if (!bothHalves) continue;
    if (const auto symmetry = symmetryOf(piece.outline))
      if (const auto partner = symmetry->partner[edge]; partner && *partner != edge)
        all.push_back({piece.id, *partner, true});
  }
  // A symmetric copy follows the piece it is the copy of, and the piece its copy.
  for (const FinishedEdge& own : std::vector<FinishedEdge>(all)) {
    const Piece& piece = *document.find(own.piece);
    const Outline image = mirrored(piece).outline;
    for (const auto& [id, other] : document.pattern.pieces)
      if (id != piece.id && (other->mirrorOf == piece.id || piece.mirrorOf == id))
        if (const auto edge = other->outline.find(image.edges[image.edges.size() - 1 - own.edge].name))
          all.push_back({id, *edge, !own.back});
  }
  return all;
}

Done resolveFinished(const Document& before, std::vector<EdgeRef>& edges, Choice& symmetric, Context& context) {
  bool any = false;
  for (EdgeRef& edge : edges) {
    edge.from = 0, edge.to = 1;
    if (Done done = resolve(before, edge); !done) return done;
    const Piece& piece = *before.find(edge.piece.id);
    // Of several pieces it is enough that one is symmetric.
    Choice one = symmetric == Choice::No ? Choice::No : Choice::Auto;
    const auto both = [&](const PaperSymmetry& there) {
      return there.partner[*piece.outline.find(edge.edge)].has_value();
    };
    if (Done done = resolveSymmetric(piece, one, context, both); !done) return done;
    any = any || one == Choice::Yes;
    if (symmetric == Choice::Yes && !any && &edge == &edges.back())
      return resolveSymmetric(piece, symmetric, context, both);
  }
  symmetric = any ? Choice::Yes : Choice::No;
  return {};
}

}  // namespace karinui
