// An edge gets a typed length.
#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/edge_length.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/edge_length.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kAsLong = 1e-7;  // metres: as long as it is to be
constexpr double kTold = 5e-5;    // metres: smaller changes are not spoken of

bool sewn(const Document& document, PieceId piece, const std::string& edge) {
  return std::any_of(document.pattern.seams.begin(), document.pattern.seams.end(), [&](const auto& seam) {
    const auto on = [&](const EdgeSpan& span) { return span.piece == piece && span.edge == edge; };
    return std::any_of(seam.second.a.begin(), seam.second.a.end(), on) ||
           std::any_of(seam.second.b.begin(), seam.second.b.end(), on);
  });
}

// Whether a seam holds both edges, one on each of its sides: an underarm, an inside leg.
bool sewnToEachOther(const Document& document, PieceId piece, const std::string& one, const std::string& other) {
  const auto on = [&](const std::vector<EdgeSpan>& side, const std::string& edge) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& span) { return span.piece == piece && span.edge == edge; });
  };
  return std::any_of(document.pattern.seams.begin(), document.pattern.seams.end(), [&](const auto& held) {
    const Seam& seam = held.second;
    return (on(seam.a, one) && on(seam.b, other)) || (on(seam.a, other) && on(seam.b, one));
  });
}

std::string inMm(double metres) { return fixed(metres * 1e3, 1); }

// "side_left: 340.0 mm -> 360.0 mm on both halves; armhole_left keeps 239.0 mm; hem_left: 241.0 mm -> 243.0 mm".
Message changes(const Outline& before, const Outline& after, const SetLength& op) {
  const std::size_t k = *before.find(op.edge.edge), n = before.edges.size();
  const auto was = [&](std::size_t e) { return before.edges[e].curve.length(); };
  const auto is = [&](std::size_t e) { return after.edges[e].curve.length(); };
  Message all = op.symmetric == Choice::Yes
                    ? say("{0}: {1} mm → {2} mm on both halves", op.edge.edge, inMm(was(k)), inMm(is(k)))
                    : say("{0}: {1} mm → {2} mm", op.edge.edge, inMm(was(k)), inMm(is(k)));
  for (const std::size_t e : {(k + n - 1) % n, (k + 1) % n}) {
    const std::string& name = before.edges[e].name;
    all = std::fabs(is(e) - was(e)) < kTold ? say("{0}; {1} keeps {2} mm", all, name, inMm(is(e)))
                                            : say("{0}; {1}: {2} mm → {3} mm", all, name, inMm(was(e)), inMm(is(e)));
  }
  return say("{0}.", all);
}

// The neighbours that were to keep their lengths and could not; also on the other half.
void tellStretched(const Outline& before, const Outline& after, const SetLength& op, const Context& context) {
  std::vector<std::string> meant{op.edge.edge};
  if (op.symmetric == Choice::Yes)
    meant.push_back(before.edges[*symmetryOf(before)->partner[*before.find(op.edge.edge)]].name);
  for (std::size_t e = 0; e < before.edges.size(); ++e) {
    const std::string& name = before.edges[e].name;
    const double was = before.edges[e].curve.length(), is = after.edges[e].curve.length();
    if (std::find(meant.begin(), meant.end(), name) == meant.end() && std::fabs(is - was) >= kTold)
      context.advise({say("{0} cannot keep its length here: {1} mm → {2} mm.", name, inMm(was), inMm(is))});
  }
}

// `alike`: edges at its ends that are sewn to each other stay alike; records of before left that out.
SetLength::Keep endThatStays(const Document& document, const Piece& piece, const std::string& edge, bool symmetric,
                             bool alike) {
  using Keep = SetLength::Keep;
  const auto& edges = piece.outline.edges;
  const std::size_t k = *piece.outline.find(edge), n = edges.size();
  const auto symmetry = symmetric ? symmetryOf(piece.outline) : std::nullopt;
  const Flat start = edges[k].curve.start, end = edges[k].curve.end;
  if (symmetry) {
    const auto onAxis = [&](Flat place) { return distance(symmetry->image(place), place) < 2e-5; };
    if (symmetry->partner[k] == k) return Keep::Middle;
    if (onAxis(start)) return canMoveEnd(piece.outline, k, false, &*symmetry) ? Keep::End : Keep::Start;
    if (onAxis(end)) return canMoveEnd(piece.outline, k, true, &*symmetry) ? Keep::Start : Keep::End;
  }
  const std::string &before = edges[(k + n - 1) % n].name, &after = edges[(k + 1) % n].name;
  if (alike && n > 2 && sewnToEachOther(document, piece.id, before, after)) return Keep::Middle;
  const bool sewnStart = sewn(document, piece.id, before), sewnEnd = sewn(document, piece.id, after);
  if (sewnStart != sewnEnd) return sewnStart ? Keep::Start : Keep::End;
  const Stand stand(piece);
  return stand(end).y > stand(start).y + 1e-6 ? Keep::End : Keep::Start;
}

using LengthenedEdge = std::pair<PieceId, std::string>;

// An edge that becomes longer by so much, and which of its ends stays.
struct Longer {
  LengthenedEdge edge;
  KeptEnd keep = KeptEnd::Start;
};

KeptEnd otherEndKept(KeptEnd keep) {
  return keep == KeptEnd::Start ? KeptEnd::End : keep == KeptEnd::End ? KeptEnd::Start : keep;
}

// The edges that these are sewn to end to end.
std::vector<Longer> sewnTo(const Document& document, const std::vector<Longer>& these) {
  std::vector<Longer> all;
  const auto whole = [](const std::vector<EdgeSpan>& side) {
    return side.size() == 1 && side.front().from == 0 && side.front().to == 1;
  };
  for (const Longer& one : these)
    for (const auto& [id, seam] : document.pattern.seams) {
      if (!whole(seam.a) || !whole(seam.b) || seam.tie != Seam::Tie::OneToOne) continue;
      for (const auto& [own, other] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
        if (own->front().piece == one.edge.first && own->front().edge == one.edge.second)
          all.push_back(
              {{other->front().piece, other->front().edge}, seam.reversed ? otherEndKept(one.keep) : one.keep});
    }
  return all;
}

// An edge with its images on the piece's other half and on symmetric copies.
std::vector<Longer> withImages(const Document& document, const Longer& one, bool bothHalves) {
  std::vector<Longer> all{one};
  const Piece& piece = *document.find(one.edge.first);
  const auto k = piece.outline.find(one.edge.second);
  const auto symmetry = bothHalves && k ? symmetryOf(piece.outline) : std::nullopt;
  if (const auto other = symmetry ? symmetry->partner[*k] : std::nullopt; other && *other != *k)
    all.push_back({{piece.id, piece.outline.edges[*other].name}, otherEndKept(one.keep)});
  for (std::size_t i = 0, here = all.size(); i < here; ++i)
    for (const PieceId copy : likenesses(document, piece.id))
      if (const auto name = edgeOnCopy(*document.find(copy), piece, all[i].edge.second))
        all.push_back({{copy, *name}, otherEndKept(all[i].keep)});
  return all;
}

Result<Document> partnersAsWell(const Document& before, Document after, const SetLength& op, KeptEnd keep,
                                Context& context) {
  const auto lengthIn = [](const Document& document, const LengthenedEdge& edge) -> std::optional<double> {
    const Outline& outline = document.find(edge.first)->outline;
    const auto k = outline.find(edge.second);
    return k ? std::optional(outline.edges[*k].curve.length()) : std::nullopt;
  };
  // Of a piece that has no other half it says nothing.
  const bool oneHalf = op.symmetric == Choice::No && symmetryOf(before.find(op.edge.piece.id)->outline).has_value();
  const double by = op.to - *lengthIn(before, {op.edge.piece.id, op.edge.edge});
  for (const Longer& one :
       sewnTo(before, withImages(before, {{op.edge.piece.id, op.edge.edge}, keep}, op.symmetric == Choice::Yes))) {
    const auto was = lengthIn(before, one.edge), is = lengthIn(after, one.edge);
    if (!was || std::fabs(*is - *was - by) < kAsLong) continue;  // a line; or the image of one that is done
    const Piece& piece = *after.find(one.edge.first);
    const auto symmetry = oneHalf ? std::nullopt : symmetryOf(piece.outline);
    const bool both = symmetry && symmetry->partner[*piece.outline.find(one.edge.second)];
    auto outline =
        withLength(piece.outline, {one.edge.second, *was + by, one.keep, op.neighbours == SetLength::Neighbours::Keep},
                   both ? &*symmetry : nullptr);
    if (!outline) return outline.error();
    ReshapePiece reshape;
    reshape.piece = one.edge.first;
    reshape.outline = *std::move(outline);
    auto next = cutAnew(after, reshape);
    if (!next) return next.error();
    after = *std::move(next);
    if (context.advise)
      context.advise({say("{0} as well: {1} mm → {2} mm.",
                          edgeSaid(before, {PieceRef(one.edge.first), one.edge.second}), inMm(*was), inMm(*was + by))});
  }
  return after;
}

}  // namespace

SetLength::Keep keptEnd(const Document& document, const Piece& piece, const std::string& edge, bool symmetric) {
  return endThatStays(document, piece, edge, symmetric, true);
}

Done resolve(const Document& before, SetLength& op, Context& context) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (!(op.to >= 1e-3 && op.to <= 10)) return refused(say("An edge is between 1 mm and 10 m long."));
  const Piece& piece = *before.find(op.edge.piece.id);
  const std::size_t k = *piece.outline.find(op.edge.edge);
  const auto both = [&](const PaperSymmetry& symmetry) { return symmetry.partner[k].has_value(); };
  if (Done done = resolveSymmetric(piece, op.symmetric, context, both); !done) return done;
  if (op.keep == SetLength::Keep::Auto)
    op.keep = endThatStays(before, piece, op.edge.edge, op.symmetric == Choice::Yes, !context.recorded);
  return {};
}

Result<Document> perform(const Document& before, const SetLength& op, Context& context) {
  const Piece& piece = *before.find(op.edge.piece.id);
  if (std::fabs(piece.outline.edges[*piece.outline.find(op.edge.edge)].curve.length() - op.to) < kAsLong) {
    if (context.advise)
      context.advise({say("Edge {0} of {1} is {2} mm long already.", op.edge.edge, piece.name, inMm(op.to))});
    return before;
  }
  const auto symmetry = op.symmetric == Choice::Yes ? symmetryOf(piece.outline) : std::nullopt;
  LengthChange change{op.edge.edge, op.to, KeptEnd::Start, op.neighbours == SetLength::Neighbours::Keep};
  if (op.keep == SetLength::Keep::End) change.keep = KeptEnd::End;
  if (op.keep == SetLength::Keep::Middle) change.keep = KeptEnd::Middle;
  auto outline = withLength(piece.outline, change, symmetry ? &*symmetry : nullptr);
  if (!outline) return outline.error();
  ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
  reshape.piece = op.edge.piece;
  reshape.symmetric = op.symmetric;
  reshape.outline = *std::move(outline);
  auto after = cutAnew(before, reshape);
  if (after && op.partners == Choice::Yes) after = partnersAsWell(before, *std::move(after), op, change.keep, context);
  if (!after || !context.advise) return after;
  context.advise({changes(piece.outline, reshape.outline, op)});
  if (change.neighboursKeep) tellStretched(piece.outline, reshape.outline, op, context);
  tellSeams(before, *after, context);
  return after;
}

}  // namespace karinui
