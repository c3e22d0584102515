// What is said of seams and pieces for those who cut and sew them.
#include <cmath>

#include "design/operations/operations.h"

namespace karinui {

Done resolve(const Document& before, DeclareEase& op, Context&) {
  if (Done done = resolve(before, op.seam); !done) return done;
  if (!(op.by >= 0 && op.by <= 10)) return refused(say("An ease lies between 0 and 10 m."));
  return {};
}

Result<Document> perform(const Document& before, const DeclareEase& op, Context&) {
  Document after = before;
  if (op.by > 0)
    after.eases[op.seam.id] = op.by;
  else
    after.eases.erase(op.seam.id);
  return after;
}

Done resolve(const Document& before, SetQuantity& op, Context&) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (op.count < 1 || op.count > kMostCut) return refused(say("A piece is cut once to {0} times.", kMostCut));
  if (op.pairs && op.count % 2 != 0) return refused(say("Pairs are an even number of pieces, not {0}.", op.count));
  return {};
}

Result<Document> perform(const Document& before, const SetQuantity& op, Context&) {
  Document after = before;
  for (const PieceRef& ref : op.pieces) {
    const Cutting cutting{op.count, op.pairs};
    if (cutting == Cutting())
      after.cutting.erase(ref.id);
    else
      after.cutting[ref.id] = cutting;
  }
  return after;
}

}  // namespace karinui
