#include "design/operations/finished_edges.h"

namespace karinui {

Done resolve(const Document& before, SetAllowance& op, Context& context) {
  if (op.edges.empty() == !op.kind.has_value())
    return refused(say("Say what the allowance is of: edges=front.hem, or kind=hem."));
  if (!op.plain && !op.width && !op.start && !op.end)
    return refused(say("Say what the allowance is to be: width=3cm, or a corner, start=mitre."));
  if (op.kind && (op.start || op.end))
    return refused(say("Corners are chosen edge by edge: edges=front.hem start=mitre."));
  if (op.width && !(*op.width >= 0 && *op.width <= kWidestAllowance))
    return refused(say("A seam allowance lies between 0 and 100 mm; usual are 7 to 15 mm."));
  return resolveFinished(before, op.edges, op.symmetric, context);
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
  for (const FinishedEdge& meant : finishedEdges(before, op.edges, op.symmetric == Choice::Yes)) {
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
