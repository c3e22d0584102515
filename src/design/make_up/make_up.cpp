#include "karinui/design/make_up.h"

namespace karinui {

std::string seamKey(const SeamProposal& seam, const Document& document) {
  std::string key;
  for (const auto* side : {&seam.sew.a, &seam.sew.b}) {
    for (const EdgeRef& edge : *side)
      key += (document.find(edge.piece.id) ? document.find(edge.piece.id)->name : "") + "." + edge.edge + " ";
    key += "/ ";
  }
  return key;
}

Result<MakingUp> makeUp(const Document& document, Context& context, const MakeUpChoices& choices) {
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
  PieceReadings readings = readPieces(now.pattern, choices.roles);
  ToldRoles told = choices.roles;
  for (Operation& copy : copiesFor(now, readings)) {
    const PieceId of = std::get<MirrorPiece>(copy).pieces.front().id;
    if (Done done = step(std::move(copy)); !done) return done.error();
    const PieceId other = now.pattern.pieces.rbegin()->first;
    if (const auto role = choices.roles.find(of); role != choices.roles.end()) told[other] = role->second;
    // What was cut twice, a left and a right one, is now two pieces that are cut once.
    if (const auto often = now.cutting.find(of); often != now.cutting.end() && often->second.count > 1) {
      SetQuantity quantity;
      quantity.pieces = {PieceRef(of), PieceRef(other)}, quantity.count = often->second.count / 2;
      if (Done done = step(std::move(quantity)); !done) return done.error();
    }
  }
  readings = readPieces(now.pattern, told);
  for (const auto& [id, reading] : readings)
    if (reading.role == PieceRole::Unknown) out.unknown.push_back(id);

  // Where pieces stand follows from what they are sewn to; they are sewn when they stand.
  Document sewn = now;
  for (SeamProposal& one : proposeSeams(now, readings)) {
    const auto chosen = choices.sewn.find(seamKey(one, now));
    if (chosen == choices.sewn.end() ? one.sure < kSureSeam : !chosen->second) {
      out.unsure.push_back(std::move(one));
      continue;
    }
    auto next = apply(sewn, one.sew, quiet);
    if (!next) {
      out.notes.push_back(next.error().what);
      out.unsure.push_back(std::move(one));
      continue;
    }
    sewn = *std::move(next);
    out.sewn.push_back(std::move(one));
  }
  auto standing = standPieces(sewn, readings, quiet);
  if (!standing) return standing.error();
  for (Operation& operation : *standing)
    if (Done done = step(std::move(operation)); !done) out.notes.push_back(done.error().what);
  for (const SeamProposal& one : out.sewn)
    if (Done done = step(one.sew); !done) out.notes.push_back(done.error().what);
  out.readings = std::move(readings);
  out.document = std::move(now);
  return out;
}

}  // namespace karinui
