#include "design/operations/copied_joins.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

// An edge of which the part has one bit, called by the whole edge's name.
void nameAsWhole(Piece& part, EdgeMap& edges) {
  std::map<std::string, std::string> names;
  for (const auto& [edge, parts] : edges) {
    std::vector<std::string> here;
    for (const EdgePart& one : parts)
      if (one.now.piece == part.id) here.push_back(one.now.edge);
    if (here.size() == 1 && here.front() != edge.second && !findEdge(part, edge.second))
      names[here.front()] = edge.second;
  }
  renameEdges(part, edges, names);
}

// The part of the piece on one side of the line, standing where it stands in the whole.
Result<Piece> partOf(const Document& before, const DuplicatePiece& op, Grading& grading) {
  const Piece& whole = *before.find(op.piece.id);
  // Records of old took a number for the other part that may be the piece's own, and lead where that led.
  const PieceId other = op.named == Choice::Yes ? mint<PieceId>(before, 0) : madeBy<PieceId>(1, 0);
  auto cut = cutPiece(whole, op.line, other, "part", {}, op.corners == Choice::Yes);
  if (!cut) return cut.error();
  if (cut->pieces.size() < 2)
    return refused(say("That line divides nothing off “{0}”; it must run from edge to edge.", whole.name));
  for (Piece& part : cut->pieces) {
    if (op.named == Choice::Yes) nameAsWhole(part, cut->edges);
    if (!op.edge.empty()) nameCutEdges(part, whole, cut->edges, op.edge);
  }
  updateGrading(grading, whole, cut->edges, {&cut->pieces[0], &cut->pieces[1]});
  if (!op.part) return cut->pieces[1];
  for (const Piece& piece : cut->pieces)
    if (contains(piece.outline.flattened(1e-4), *op.part)) return piece;
  return refused(say("The place of the part to copy is not on “{0}”.", whole.name));
}

}  // namespace

Done resolve(const Document& before, DuplicatePiece& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (!op.line.empty() && op.corners == Choice::Auto && !context.recorded) op.corners = Choice::Yes;
  if (!op.line.empty() && op.named == Choice::Auto && !context.recorded) op.named = Choice::Yes;
  if (!op.edge.empty())
    if (Done done = checkEdgeName(op.edge); !done) return done;
  if (op.line.empty()) decideSeamsWithin(before, op.piece.id, op.seams, context);
  if (op.name.empty()) op.name = usableName(before, before.find(op.piece.id)->name);
  if (!(length(op.by) <= 100)) return refused(say("A piece is moved by at most {0} m.", 100));
  if (op.part && op.line.empty())
    return refused(say("Say the line that divides off the part: line=\"u,v; u,v\", from edge to edge."));
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const DuplicatePiece& op, Context& context) {
  Piece copy = *before.find(op.piece.id);
  Grading grading = before.grading;
  if (!op.line.empty()) {
    auto part = partOf(before, op, grading);
    if (!part) return part.error();
    copy = *std::move(part);
  }
  const auto graded = grading.pieces.extract(copy.id);
  copy.id = mint<PieceId>(before, 0);
  copy.name = op.name;
  copy.pose.carry += op.by;
  copy.mirrorOf = PieceId();
  Document after = before;
  if (const auto look = before.looks.pieces.find(op.piece.id); look != before.looks.pieces.end())
    after.looks.pieces[copy.id] = look->second;
  if (const auto shift = before.looks.shifts.find(op.piece.id); shift != before.looks.shifts.end())
    after.looks.shifts[copy.id] = shift->second;
  const PieceId id = copy.id;
  if (graded) after.grading.pieces[id] = graded.mapped();
  if (const auto own = before.cutting.find(op.piece.id); own != before.cutting.end()) after.cutting[id] = own->second;
  const auto give = [&](auto& all) {
    for (const auto& [at, own] : std::decay_t<decltype(all)>(all))
      if (at.first == op.piece.id) all[{id, at.second}] = own;
  };
  give(after.allowances.edges), give(after.allowances.corners), Allowances::eachFinish(after.allowances, give);
  after = withPiece(std::move(after), std::move(copy));
  updateAllowances(after.allowances, {}, after.pattern);  // a part has not all the edges
  if (!op.line.empty()) return after;
  if (op.seams == Choice::Yes) after = withCopiedSeams(std::move(after), op.piece.id, id, false);
  return withCopiedFastenings(std::move(after), op.piece.id, {{op.piece.id, id}}, false, context);
}

}  // namespace karinui
