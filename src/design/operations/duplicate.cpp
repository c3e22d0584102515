#include "design/operations/copied_joins.h"
#include "karinui/base/number.h"
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

// Which end of the line does not reach an edge: of a symmetric piece, whose middle is none, that is easily mistaken.
Error dividesNothing(const Piece& whole, const std::vector<Flat>& line) {
  constexpr double kInside = 1e-3;  // metres
  const Ring ring = whole.outline.flattened(1e-4);
  for (const Flat end : {line.front(), line.back()})
    if (const double far = distanceToRing(ring, end); contains(ring, end) && far > kInside)
      return refused(
          say("That line divides nothing off “{0}”: its end {1}, {2} mm lies within the piece, {3} mm from the nearest "
              "edge. Lead both its ends to an edge or beyond.",
              whole.name, fixed(end.u * 1e3, 1), fixed(end.v * 1e3, 1), fixed(far * 1e3, 0)));
  return refused(say("That line divides nothing off “{0}”; it must run from edge to edge.", whole.name));
}

// The part of the piece on one side of the line, standing where it stands in the whole.
Result<Piece> partOf(const Document& before, const DuplicatePiece& op, Grading& grading) {
  const Piece& whole = *before.find(op.pieces.front().id);
  // Records of old took a number for the other part that may be the piece's own, and lead where that led.
  const PieceId other = op.named == Choice::Yes ? mint<PieceId>(before, 0) : madeBy<PieceId>(1, 0);
  auto cut = cutPiece(whole, op.line, other, "part", {}, op.corners == Choice::Yes);
  if (!cut) return cut.error();
  if (cut->pieces.size() < 2) return dividesNothing(whole, op.line);
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
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (!op.line.empty() && op.corners == Choice::Auto && !context.recorded) op.corners = Choice::Yes;
  if (!op.line.empty() && op.named == Choice::Auto && !context.recorded) op.named = Choice::Yes;
  if (!op.edge.empty())
    if (Done done = checkEdgeName(op.edge); !done) return done;
  if (op.line.empty()) decideSeamsWithin(before, op.pieces, op.seams, context);
  if (!(length(op.by) <= 100)) return refused(say("A piece is moved by at most {0} m.", 100));
  if (op.part && op.line.empty())
    return refused(say("Say the line that divides off the part: line=\"u,v; u,v\", from edge to edge."));
  if (op.pieces.size() > 1) {
    if (!op.line.empty()) return refused(say("A line divides off a part of one piece; several are named."));
    return checkNoNameOfSeveral(op.name);
  }
  if (op.name.empty()) op.name = usableName(before, before.find(op.pieces.front().id)->name);
  return checkNewName(before, op.name);
}

namespace {

// The copy, with what the piece has beside its outline.
Result<Document> withCopy(Document document, const Document& before, const DuplicatePiece& op, PieceId of, PieceId id) {
  Piece copy = *before.find(of);
  Grading grading = before.grading;
  if (!op.line.empty()) {
    auto part = partOf(before, op, grading);
    if (!part) return part.error();
    copy = *std::move(part);
  }
  const auto graded = grading.pieces.extract(copy.id);
  copy.id = id;
  copy.name = op.name.empty() ? usableName(document, copy.name) : op.name;
  copy.pose.carry += op.by;
  copy.mirrorOf = PieceId();
  if (const auto look = before.looks.pieces.find(of); look != before.looks.pieces.end())
    document.looks.pieces[id] = look->second;
  if (const auto shift = before.looks.shifts.find(of); shift != before.looks.shifts.end())
    document.looks.shifts[id] = shift->second;
  if (graded) document.grading.pieces[id] = graded.mapped();
  if (const auto own = before.cutting.find(of); own != before.cutting.end()) document.cutting[id] = own->second;
  const auto give = [&](auto& all) {
    for (const auto& [at, own] : std::decay_t<decltype(all)>(all))
      if (at.first == of) all[{id, at.second}] = own;
  };
  give(document.allowances.edges), give(document.allowances.corners);
  Allowances::eachFinish(document.allowances, give);
  document = withPiece(std::move(document), std::move(copy));
  updateAllowances(document.allowances, {}, document.pattern);  // a part has not all the edges
  return document;
}

}  // namespace

Result<Document> perform(const Document& before, const DuplicatePiece& op, Context& context) {
  Document after = before;
  CopiesOf copies;
  for (const PieceRef& piece : op.pieces) {
    const PieceId id = mint<PieceId>(before, static_cast<std::uint32_t>(copies.size()));
    copies[piece.id] = id;
    auto next = withCopy(std::move(after), before, op, piece.id, id);
    if (!next) return next.error();
    after = *std::move(next);
  }
  // The symmetric copy of a piece that is copied with it is that of the copy.
  for (const auto& [of, copy] : copies)
    if (const auto first = copies.find(before.find(of)->mirrorOf); first != copies.end())
      after = withLikeness(std::move(after), first->second, copy);
  if (!op.line.empty()) return after;
  if (op.seams == Choice::Yes) after = withCopiedSeams(std::move(after), op.pieces, copies, false);
  return withCopiedFastenings(std::move(after), op.pieces, copies, false, context);
}

}  // namespace karinui
