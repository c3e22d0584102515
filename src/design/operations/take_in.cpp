// Seams are taken in or let out.
#include <algorithm>
#include <cmath>
#include <set>

#include "design/operations/operations.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kMost = 0.5;  // metres

using Named = std::pair<PieceId, std::string>;

bool lies(const EdgeSpan& span, const Named& edge) { return span.piece == edge.first && span.edge == edge.second; }

// Those of the operation, each followed by what it is sewn to.
std::vector<Named> meant(const Document& document, const TakeIn& op) {
  std::vector<Named> all;
  const auto add = [&](const Named& edge) {
    if (std::find(all.begin(), all.end(), edge) == all.end()) all.push_back(edge);
  };
  for (const EdgeRef& ref : op.edges) {
    const Named edge{ref.piece.id, ref.edge};
    add(edge);
    if (op.partners == Choice::No) continue;
    for (const auto& [id, seam] : document.pattern.seams)
      for (const auto& [own, other] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
        if (std::any_of(own->begin(), own->end(), [&](const EdgeSpan& span) { return lies(span, edge); }))
          for (const EdgeSpan& span : *other) add({span.piece, span.edge});
  }
  return all;
}

}  // namespace

Done resolve(const Document& before, TakeIn& op, Context& context) {
  if (op.by == 0.0 || !(std::fabs(op.by) <= kMost))
    return refused(say("A seam is taken in or let out by up to 50 cm, not by {0} mm.", fixed(op.by * 1e3, 1)));
  if (op.whole == Choice::Auto && !context.recorded) op.whole = Choice::Yes;
  return resolveWhole(before, op.edges, op.symmetric, context);
}

Result<Document> perform(const Document& before, const TakeIn& op, Context& context) {
  Document after = before;
  std::set<Named> moved;
  std::string said;
  for (const Named& edge : meant(before, op)) {
    if (moved.contains(edge)) continue;
    const Piece piece = *after.find(edge.first);
    auto in = moveEdge(piece, edge.second, op.by, op.whole == Choice::Yes);
    if (!in) return in.error();
    moved.insert(edge);
    ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
    reshape.piece = edge.first;
    reshape.outline = std::move(in->outline);
    const auto symmetry = op.symmetric == Choice::No ? std::nullopt : symmetryOf(piece.outline);
    if (const auto k = piece.outline.find(edge.second); symmetry && k) {
      if (const auto other = symmetry->partner[*k]) moved.insert({edge.first, piece.outline.edges[*other].name});
      reshape.outline = onBothHalves(piece.outline, std::move(reshape.outline), *symmetry);
    }
    const Document was = after;
    auto next = perform(was, reshape, context);
    if (!next) return next.error();
    after = *std::move(next);
    for (const auto& [id, one] : after.pattern.pieces) {  // symmetric copies have followed
      const Piece& old = *was.find(id);
      if (id != edge.first && one->outline != old.outline) moved.insert({id, otherSide(edge.second)});
    }
    said += (said.empty() ? "" : ", ") + piece.name + "." + edge.second;
  }
  if (context.advise)
    context.advise({op.by > 0 ? say("Taken in by {0} mm: {1}.", fixed(op.by * 1e3, 1), said)
                              : say("Let out by {0} mm: {1}.", fixed(-op.by * 1e3, 1), said)});
  tellMisfits(before, after, context);
  return after;
}

}  // namespace karinui
