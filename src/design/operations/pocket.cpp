// A pocket in a seam: what is its opening becomes a seam of its own, which holds the pocket closed as basting does. Of
// the bags the front one is caught in along the edge of the piece, and turned in as a facing is; the back one lies
// behind it, and the cloth of the other edge goes on with it, as with the shield of a fly. Both are cut by one line,
// and sewn to each other along it.
#include <array>

#include "design/operations/pocket_pieces.h"
#include "design/operations/said.h"
#include "design/operations/seam_parts.h"
#include "karinui/pattern/darts.h"

namespace karinui {

namespace {

constexpr double kUsualFirst = 0.04;  // metres

struct PocketOpening {
  double from = 0, to = 0;  // metres, from the edge's upper end down
};
PocketOpening openingOf(const SewPocket& op) {
  const double from = op.first.value_or(Length{kUsualFirst});
  return {from, from + op.length};
}

// The seam that holds all of the bag's edge, and which part of it is that, and the opening.
struct PocketSeam {
  SeamId id;
  bool onA = true;
  SeamStretch bag, opening;
};
std::optional<PocketSeam> pocketSeamOf(const Document& document, const SewPocket& op, const DownEdge& side,
                                       const BagSize& size) {
  constexpr double kMissing = 1e-3;  // metres of the edge that may be sewn otherwise
  const auto [from, to] = openingOf(op);
  for (const auto& [id, seam] : document.pattern.seams) {
    if (seam.tie == Seam::Tie::Pleat) continue;
    for (const bool onA : {true, false}) {
      const auto bag = coveredBy(document.pattern, seam, onA, {side.span(size.from, size.to)});
      const auto opening = coveredBy(document.pattern, seam, onA, {side.span(from, to)});
      if (!bag || !opening) continue;
      const double whole = length(document.pattern, onA ? seam.a : seam.b);
      if ((bag->to - bag->from) * whole > size.to - size.from - kMissing) return PocketSeam{id, onA, *bag, *opening};
    }
  }
  return std::nullopt;
}

// The bags hang from the edge above where that is a waist: level, and near to the opening. Elsewhere, as below an
// armhole, they hang from the side alone.
BagSize bagSizeOf(const Document& document, const SewPocket& op, const DownEdge& side) {
  constexpr double kNearWaist = 0.10, kLeastTop = 0.05;  // metres
  const auto [from, to] = openingOf(op);
  const BagSize free{std::max(0.0, from - kBagBeyond), to + kBagBeyond, to, op.depth, op.below, 0,
                     op.copies == Choice::Yes};
  const EdgeAbove above = edgeAbove(side);
  const Flat chord = above.edge.curve.end - above.edge.curve.start;
  const double top = std::min(op.depth.metres, above.whole - kToNextCorner);
  if (from > kNearWaist || top < kLeastTop || std::abs(chord.v) > std::abs(chord.u) / 2) return free;
  for (const std::string_view leg : {std::string_view(side.edge.name), std::string_view(above.edge.name)})
    if (dartWithLeg(document.pattern, side.piece.id, leg)) return free;
  BagSize hung = free;
  hung.from = 0, hung.top = top;
  return pocketSeamOf(document, op, side, hung) && bagLine(document.pattern, side, hung) ? hung : free;
}

Done checkPocketAt(const Document& document, const SewPocket& op, const EdgeRef& edge) {
  if (op.kind == SewPocket::Kind::Slant) return checkSlanted(document, op, edge);
  const DownEdge side = downEdgeOf(document, edge);
  const BagSize size = bagSizeOf(document, op, side);
  if (size.to > side.whole)
    return refused(say("{0} is {1} cm long; this opening ends {2} cm down it, and its bags go on for 1.5 cm.",
                       edge.edge, centimetres(side.whole), centimetres(size.low)));
  if (!pocketSeamOf(document, op, side, size))
    return refused(
        say("{0} of “{1}” is not sewn to another edge all along from {2} to {3} cm down, where the pocket "
            "would be; sew it first, or choose another place.",
            edge.edge, side.piece.name, centimetres(size.from), centimetres(size.to)));
  if (const auto bag = bagBeside(document.pattern, side, size); !bag) return bag.error();
  return {};
}

// Another pocket is not there already.
Done checkPlaceFree(const Document& document, const SewPocket& op, const EdgeRef& edge) {
  const DownEdge side = downEdgeOf(document, edge);
  if (op.kind == SewPocket::Kind::Slant) return checkFree(document, side, 0, op.length + kBagBeyond);
  const BagSize size = bagSizeOf(document, op, side);
  return checkFree(document, side, size.from, size.to);
}

// Where the opening begins and ends, on the bag's edge.
std::vector<Mark> openingMarks(const EdgeSpan& span, const DownEdge& side, const PocketOpening& opening) {
  std::vector<Mark> marks;
  for (const double down : {opening.from, opening.to}) {
    const double share = side.down ? down / side.whole : 1 - down / side.whole;
    marks.push_back({"", kBagSide, (share - span.from) / (span.to - span.from), {}});
  }
  return marks;
}

// The opening's part of the seam becomes one of its own.
void openSeam(PocketPieces& made, const Seam& seam, SeamStretch stretch, bool first) {
  const Document was = made.after;
  Seam opening = partWithin(was.pattern, seam, stretch).seam;
  replaceByParts(was, made.after, seam.id, partsBeside(was.pattern, seam, stretch), made.freeSeams());
  opening.id = made.seamId(), opening.name = made.openingName(first);
  if (const auto ease = was.eases.find(seam.id); ease != was.eases.end())
    made.after.eases[opening.id] = ease->second * (stretch.to - stretch.from);
  made.after.pattern.seams[opening.id] = std::move(opening);
}

// The bags behind an edge: the front's and the back's.
Result<std::array<PieceId, 2>> sewnBehind(PocketPieces& made, const SewPocket& op, const EdgeRef& edge, bool first) {
  const Piece outer = *made.after.find(edge.piece.id);
  const DownEdge side = downEdgeOf(made.after, edge);
  const BagSize size = bagSizeOf(made.after, op, side);
  const PocketSeam at = *pocketSeamOf(made.after, op, side, size);
  const Seam seam = *made.after.find(at.id);
  const auto paper = bagBeside(made.after.pattern, side, size);
  if (!paper) return paper.error();
  const std::vector<Mark> marks = openingMarks(side.span(size.from, size.to), side, openingOf(op));
  std::array<PieceId, 2> bags;
  for (const std::size_t k : {0u, 1u}) {
    const auto bag =
        made.addBag(*paper, marks, outer, k == 0 ? 1 : 2, made.nameOf(k == 0 ? "bag_front" : "bag_back", first));
    if (!bag) return bag.error();
    bags[k] = *bag;
  }
  const auto run = [&](PieceId bag, bool withSide) {
    std::vector<EdgeSpan> spans;
    for (const DividedPart::EdgePart& part : paper->edges)
      if (withSide || part.own.edge != kBagSide) spans.push_back({bag, part.own.edge, 0, 1});
    if (!withSide) spans.insert(side.down ? spans.begin() : spans.end(), {bag, paper->inner, 0, 1});
    return spans;
  };
  std::vector<EdgeSpan> outerRun;
  for (const DividedPart::EdgePart& part : paper->edges) outerRun.push_back(part.piece);
  const Seam held = partWithin(made.after.pattern, seam, at.bag).seam;
  // Pleat: the edges are sewn to each other as well.
  made.sew(std::move(outerRun), run(bags[0], true), Seam::Tie::Pleat, false);
  made.sew(at.onA ? held.b : held.a, {{bags[1], kBagSide, 0, 1}}, Seam::Tie::Pleat, seam.reversed);
  made.sew(run(bags[0], false), run(bags[1], false), Seam::Tie::OneToOne, false);
  openSeam(made, seam, at.opening, first);
  return bags;
}

Result<Document> withSeamPocket(const Document& before, const SewPocket& op) {
  PocketPieces made(before, op, before);
  const std::vector<EdgeRef> edges = pocketEdges(before, op);
  std::vector<PieceId> outers;
  for (const EdgeRef& edge : edges) {
    const DownEdge beside = downEdgeOf(before, edge);
    const Seam& seam = *before.find(pocketSeamOf(before, op, beside, bagSizeOf(before, op, beside))->id);
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) outers.push_back(span.piece);
  }
  if (Done done = made.room(outers); !done) return done.error();
  std::vector<std::array<PieceId, 2>> bags;
  for (const EdgeRef& edge : edges) {
    const auto both = sewnBehind(made, op, edge, bags.empty());
    if (!both) return both.error();
    bags.push_back(*both);
  }
  if (bags.size() == 2)
    for (const std::size_t k : {0u, 1u}) made.after = withLikeness(std::move(made.after), bags[0][k], bags[1][k]);
  return std::move(made.after);
}

}  // namespace

Done resolve(const Document& before, SewPocket& op, Context& context) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (!before.find(op.edge.piece.id)->outline.find(op.edge.edge))
    return refused(say("A pocket is sewn into the seam of an outline's edge; {0} is none.", op.edge.edge));
  if (Done done = checkName(op.name); !done) return done;
  const bool slant = op.kind == SewPocket::Kind::Slant;
  if (slant && op.first)
    return refused(say("A slanted pocket begins at the upper end of the edge: leave first= away."));
  if (!slant && op.inset)
    return refused(say("Only a slanted pocket (kind=slant) begins on the edge above: leave inset= away."));
  std::optional<Length>& begins = slant ? op.inset : op.first;
  if (!begins) begins = Length{kUsualFirst};
  if (!slant && !(*op.first >= 0 && *op.first <= 1))
    return refused(say("The opening of a pocket begins 0 to 100 cm below the upper end."));
  if (slant && !(*op.inset >= 0.01 && *op.inset <= 0.2))
    return refused(say("A slanted pocket begins 1 to 20 cm from the corner."));
  if (!(op.length >= 0.05 && op.length <= 0.4)) return refused(say("The opening of a pocket is 5 to 40 cm long."));
  if (!(op.depth >= 0.04 && op.depth <= 0.4)) return refused(say("The bags of a pocket are 4 to 40 cm deep."));
  if (!(op.below >= 0.02 && op.below <= 0.4))
    return refused(say("The bags of a pocket hang 2 to 40 cm below the opening."));
  if (op.fabric.empty()) op.fabric = "cotton";
  if (Done done = checkFabricName(before, op.fabric); !done) return done;
  const auto check = [&](const EdgeRef& edge) -> Done {
    if (!context.recorded)
      if (Done done = checkPlaceFree(before, op, edge); !done) return done;
    return checkPocketAt(before, op, edge);
  };
  if (Done done = check(op.edge); !done) return done;
  const auto image = edgeOnOtherHalf(before, op.edge);
  if (op.copies == Choice::Yes && !image)
    return refused(say("“{0}” has no symmetric copy or other half with an edge like {1}; leave copies= away.",
                       before.find(op.edge.piece.id)->name, op.edge.edge));
  if (op.copies == Choice::Auto && !context.recorded && image && check(*image)) {
    op.copies = Choice::Yes;
    if (Done done = check(op.edge); !done) return done;  // they may meet
  }
  return op.copies == Choice::Yes ? check(*image) : Done();
}

Result<Document> perform(const Document& before, const SewPocket& op, Context& context) {
  return op.kind == SewPocket::Kind::Slant ? withSlanted(before, op, context) : withSeamPocket(before, op);
}

}  // namespace karinui
