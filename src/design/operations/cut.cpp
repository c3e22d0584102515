#include <algorithm>

#include "design/operations/operations.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

constexpr std::size_t kMostPlaces = 10000;

// Pins stay in the cloth they are in: those beyond the cut go over to the second piece.
void sharePins(Document& document, const Piece& first, const Piece& second) {
  const auto at = document.pins.find(first.id);
  if (at == document.pins.end()) return;
  const Ring mine = first.outline.flattened(1e-4), other = second.outline.flattened(1e-4);
  std::vector<Flat> kept, gone;
  for (const Flat pin : at->second) {
    const auto away = [&](const Ring& ring) { return contains(ring, pin) ? 0.0 : distanceToRing(ring, pin); };
    (away(mine) <= away(other) ? kept : gone).push_back(pin);
  }
  at->second = std::move(kept);
  if (at->second.empty()) document.pins.erase(at);
  if (!gone.empty()) document.pins[second.id] = std::move(gone);
}

// A cut piece is no longer its symmetric copy's likeness.
void tellUnlike(const Document& before, const Piece& piece, const Context& context) {
  if (!context.advise) return;
  for (const auto& [id, other] : before.pattern.pieces)
    if (id != piece.id && (other->mirrorOf == piece.id || piece.mirrorOf == id))
      context.advise({say("“{0}” and “{1}” are no longer alike: what is done to one is not done to the other any more.",
                          piece.name, other->name)});
}

}  // namespace

Done resolve(const Document& before, CutPiece& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.line.size() < 2) return refused(say("A cut needs a line of at least two places."));
  if (op.line.size() > kMostPlaces) return refused(say("The line of a cut has more than {0} places.", kMostPlaces));
  for (const Flat place : op.line)
    if (!(length(place) <= 1000)) return refused(say("The line of the cut leaves the table."));
  if (op.name.empty()) {
    op.name = usableName(before, before.find(op.piece.id)->name);
    return {};
  }
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const CutPiece& op, Context& context) {
  auto cut = cutPiece(*before.find(op.piece.id), op.line, mint<PieceId>(before, 0), op.name,
                      linesOfLattice(withElasticLines(before.pattern, before.allowances), *before.find(op.piece.id)));
  if (!cut) return cut.error();
  tellUnlike(before, *before.find(op.piece.id), context);
  Document after = before;
  updateSeams(after.pattern, cut->edges);
  if (cut->pieces.size() > 1) sharePins(after, cut->pieces[0], cut->pieces[1]);
  const Piece& whole = *before.find(op.piece.id);
  std::vector<const Piece*> parts;
  for (const Piece& piece : cut->pieces) parts.push_back(&piece);
  updateGrading(after.grading, whole, cut->edges, parts);
  const bool own = before.looks.pieces.contains(whole.id) || before.looks.pieces.contains(whole.mirrorOf);
  for (Piece& piece : cut->pieces) {
    if (own) after.looks.pieces[piece.id] = lookOf(before, whole);
    if (const auto shift = before.looks.shifts.find(whole.id); shift != before.looks.shifts.end())
      after.looks.shifts[piece.id] = shift->second;
    piece.mirrorOf = PieceId();  // no longer the other's likeness
    after = withPiece(std::move(after), std::move(piece));
  }
  updateAllowances(after.allowances, cut->edges, after.pattern);
  return after;
}

}  // namespace karinui
