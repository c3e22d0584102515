#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, Unsew& op, Context&) {
  if (op.seams.empty()) return refused(say("Say which seam is meant."));
  for (SeamRef& seam : op.seams)
    if (Done done = resolve(before, seam); !done) return done;
  return {};
}

Result<Document> perform(const Document& before, const Unsew& op, Context&) {
  Document after = before;
  for (const SeamRef& ref : op.seams) {
    const auto at = after.pattern.seams.find(ref.id);
    if (at == after.pattern.seams.end()) continue;  // named twice
    for (const auto* side : {&at->second.a, &at->second.b})
      for (const EdgeSpan& span : *side) after.drape.dirty.insert(span.piece);
    after.pattern.seams.erase(at);
  }
  return after;
}

}  // namespace karinui
