#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, FlipSeam& op, Context&) { return resolve(before, op.seam); }

Result<Document> perform(const Document& before, const FlipSeam& op, Context&) {
  Document after = before;
  Seam& seam = after.pattern.seams.at(op.seam.id);
  seam.reversed = !seam.reversed;
  for (const auto* side : {&seam.a, &seam.b})
    for (const EdgeSpan& span : *side) after.drape.dirty.insert(span.piece);
  return after;
}

}  // namespace karinui
