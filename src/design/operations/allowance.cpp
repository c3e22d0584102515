#include <algorithm>

#include "design/operations/operations.h"

namespace karinui {

namespace {

// An edge the operation is about; `back`: it runs the other way, as on the other half of a piece.
struct Meant {
  PieceId piece;
  std::size_t edge = 0;
  bool back = false;
};

std::vector<Meant> meantBy(const Document& document, const SetAllowance& op) {
  std::vector<Meant> all;
  for (const EdgeRef& ref : op.edges) {
    const Piece& piece = *document.find(ref.piece.id);
    const std::size_t edge = *piece.outline.find(ref.edge);
    all.push_back({piece.id, edge, false});
    if (op.symmetric != Choice::Yes) continue;
    if (const auto symmetry = symmetryOf(piece.outline))
      if (const auto partner = symmetry->partner[edge]; partner && *partner != edge)
        all.push_back({piece.id, *partner, true});
  }
  // A symmetric copy follows the piece it is the copy of, and the piece its copy.
  for (const Meant& own : std::vector<Meant>(all)) {
    const Piece& piece = *document.find(own.piece);
    const Outline image = mirrored(piece).outline;
    for (const auto& [id, other] : document.pattern.pieces)
      if (id != piece.id && (other->mirrorOf == piece.id || piece.mirrorOf == id))
        if (const auto edge = other->outline.find(image.edges[image.edges.size() - 1 - own.edge].name))
          all.push_back({id, *edge, !own.back});
  }
  return all;
}

}  // namespace

Done resolve(const Document& before, SetAllowance& op, Context& context) {
  if (op.edges.empty() == !op.kind.has_value())
    return refused(say("Say what the allowance is of: edges=front.hem, or kind=hem."));
  if (!op.plain && !op.width && !op.start && !op.end)
    return refused(say("Say what the allowance is to be: width=3cm, or a corner, start=mitre."));
  if (op.kind && (op.start || op.end))
    return refused(say("Corners are chosen edge by edge: edges=front.hem start=mitre."));
  if (op.width && !(*op.width >= 0 && *op.width <= kWidestAllowance))
    return refused(say("A seam allowance lies between 0 and 100 mm; usual are 7 to 15 mm."));
  bool any = false;
  for (EdgeRef& edge : op.edges) {
    edge.from = 0, edge.to = 1;
    if (Done done = resolve(before, edge); !done) return done;
    const Piece& piece = *before.find(edge.piece.id);
    // Of several pieces it is enough that one is symmetric.
    Choice symmetric = op.symmetric == Choice::No ? Choice::No : Choice::Auto;
    const auto both = [&](const PaperSymmetry& symmetry) {
      return symmetry.partner[*piece.outline.find(edge.edge)].has_value();
    };
    if (Done done = resolveSymmetric(piece, symmetric, context, both); !done) return done;
    any = any || symmetric == Choice::Yes;
    if (op.symmetric == Choice::Yes && !any && &edge == &op.edges.back())
      return resolveSymmetric(piece, op.symmetric, context, both);
  }
  op.symmetric = any ? Choice::Yes : Choice::No;
  return {};
}

Result<Document> perform(const Document& before, const SetAllowance& op, Context&) {
  Document after = before;
  Allowances& all = after.allowances;
  if (op.kind) {
    if (op.plain) all.kinds.erase(*op.kind);
    if (op.width) all.kinds[*op.kind] = *op.width;
    if (const auto own = all.kinds.find(*op.kind); own != all.kinds.end() && own->second == usualAllowance(*op.kind))
      all.kinds.erase(own);
    return after;
  }
  for (const Meant& meant : meantBy(before, op)) {
    const auto& edges = before.find(meant.piece)->outline.edges;
    const Allowances::At at{meant.piece, edges[meant.edge].name},
        next{meant.piece, edges[(meant.edge + 1) % edges.size()].name};
    if (op.plain) all.edges.erase(at), all.corners.erase(at), all.corners.erase(next);
    if (op.width) all.edges[at] = *op.width;
    if (op.start) all.corners[meant.back ? next : at] = meant.back ? mirrored(*op.start) : *op.start;
    if (op.end) all.corners[meant.back ? at : next] = meant.back ? mirrored(*op.end) : *op.end;
  }
  return after;
}

}  // namespace karinui
