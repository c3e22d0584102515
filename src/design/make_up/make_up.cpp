#include "karinui/design/make_up.h"

namespace karinui {

Result<MakingUp> makeUp(const Document& document, Context& context) {
  MakingUp out;
  Document now = document;
  Context quiet = context;  // of seams that cross the body it is told when they are sewn, not here
  quiet.advise = {};
  const auto step = [&](Operation operation) -> Done {
    auto next = apply(now, operation, quiet);
    if (!next) return next.error();
    now = *std::move(next);
    out.steps.push_back(std::move(operation));
    return {};
  };
  PieceReadings readings = readPieces(now.pattern);
  for (Operation& copy : copiesFor(now, readings))
    if (Done done = step(std::move(copy)); !done) return done.error();
  readings = readPieces(now.pattern);
  for (const auto& [id, reading] : readings)
    if (reading.role == PieceRole::Unknown) out.unknown.push_back(id);

  // Where pieces stand follows from what they are sewn to; they are sewn when they stand.
  std::vector<SewEdges> sure;
  Document sewn = now;
  for (SeamProposal& one : proposeSeams(now, readings)) {
    if (one.sure < kSureSeam) {
      out.unsure.push_back(std::move(one));
      continue;
    }
    auto next = apply(sewn, one.sew, quiet);
    if (!next) {
      out.notes.push_back(next.error().what);
      continue;
    }
    sewn = *std::move(next);
    sure.push_back(std::move(one.sew));
  }
  auto standing = standPieces(sewn, readings, quiet);
  if (!standing) return standing.error();
  for (Operation& operation : *standing)
    if (Done done = step(std::move(operation)); !done) out.notes.push_back(done.error().what);
  for (SewEdges& sew : sure)
    if (Done done = step(std::move(sew)); !done) out.notes.push_back(done.error().what);
  return out;
}

}  // namespace karinui
