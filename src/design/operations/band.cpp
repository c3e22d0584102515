// A band as long as a run of edges, on its own or stood and sewn along them.
#include <cmath>

#include "design/operations/new_piece.h"
#include "design/sewn_corners.h"
#include "design/spoken.h"
#include "karinui/design/sewing.h"

namespace karinui {

Outline rectangleOf(double width, double height, const std::vector<std::string>& edges) {
  const Flat a{-width / 2, 0}, b{width / 2, 0}, c{width / 2, height}, d{-width / 2, height};
  return {{{edges[0], Curve::line(a, b)},
           {edges[1], Curve::line(b, c)},
           {edges[2], Curve::line(c, d)},
           {edges[3], Curve::line(d, a)}}};
}

namespace {

// Where a garment opens a band that is sewn past the opening holds it shut, which looks like any other collar.
void tellShut(const Document& before, const DrawBand& op, bool closed, const Context& context) {
  if (!context.advise) return;
  for (std::size_t k = 0; k < op.of.size(); ++k) {
    const bool last = k + 1 == op.of.size();
    if (last && !closed) continue;
    const EdgeRef &edge = op.of[k], &next = op.of[last ? 0 : k + 1];
    if (goesOnSewn(before, edge, next)) continue;
    context.advise(
        {say("“{0}” goes on from {1} to {2}, which nothing else holds together there. If the garment opens "
             "there, begin the band at the opening (of=) and leave it a lap: extra=3cm.",
             op.name, spoken(before, edge), spoken(before, next))});
  }
}

}  // namespace

Done resolve(const Document& before, DrawBand& op, Context& context) {
  if (Done done = checkPaper(before, {op.name, op.fabric, op.layer}); !done) return done;
  const bool byId = !op.of.empty() && op.of.front().piece.id;
  if (Done done = orderRun(before, op.of); !done) return done;
  if (!(op.depth > 0 && op.depth <= 3)) return refused(say("A band is between 1 mm and 3 m deep."));
  if (!(op.ratio >= 0.1 && op.ratio <= 10))
    return refused(say("A band's ratio lies between 0.1 and 10; 1 is as long as its edges."));
  if (!(op.extra >= 0 && op.extra <= 1)) return refused(say("What is added to a band lies between 0 and 1 m."));
  if (!(std::abs(op.turn) <= 4)) return refused(say("That turn is too large."));
  if (op.edges.empty()) op.edges = {"low", "end_left", "top", "end_right"};
  if (op.edges.size() != 4)
    return refused(say("This shape has {0} {0|edge|edges}; it got {1} {1|name|names}.", 4, op.edges.size()));
  if (op.sew && op.ratio != 1 && op.eased == Choice::Auto && !context.recorded) op.eased = Choice::Yes;
  if (op.sew) decideClear(op.turn, op.clear, context);
  if (op.turned && !op.sew) return refused(say("Only a band that is sewn on is turned over: sew=yes."));
  if (op.round && !op.sew) return refused(say("Only a band that is sewn on is led round the body: sew=yes."));
  if (!op.wrap.empty() && !op.sew) return refused(say("Only a band that is sewn on is led round the body: sew=yes."));
  if (!op.wrap.empty() && op.wrap != op.edges[1] && op.wrap != op.edges[3])
    return refused(
        say("One end of “{0}” lies on top, {1} or {2}; “{3}” is neither.", op.name, op.edges[1], op.edges[3], op.wrap));
  const bool ring = op.sew && op.extra <= 1e-3 && op.wrap.empty() && closesRing(before, op.of);
  // Said anew of a record: its edges are named by the ids of their pieces.
  if (op.joined == Choice::Yes && !ring && byId) op.joined = Choice::Auto;
  if (op.joined == Choice::Yes && !ring)
    return refused(
        say("Only a band that is sewn along edges that close a ring, without a lap, has its ends sewn to each other; "
            "leave joined= away."));
  if (!op.sew) return {};
  // A ring that opens somewhere, as at a fly, is begun there, wherever it is named from.
  if (!context.recorded && goesOnSewn(before, op.of.back(), op.of.front())) op.of = fromOpening(before, op.of);
  if (op.joined == Choice::Auto && !context.recorded && ring && opensBetween(before, op.of.back(), op.of.front())) {
    op.joined = Choice::No;
    if (context.advise)
      context.advise(
          {say("The ends of “{0}” stay open, as the garment does between {1} and {2}: fasten them, or leave it "
               "a lap, extra=3cm; joined=yes sews them to each other.",
               op.name, spoken(before, op.of.back()), spoken(before, op.of.front()))});
  }
  if (Done done = decideRound(before, op.of, op.round, context); !done) return done;
  for (const EdgeRef& edge : op.of)
    for (const SeamId id : seamsOn(before, {edge}))
      return refused(say("{0} is already sewn by seam {1}; take that out first.", edge.edge,
                         before.find(id)->name.empty() ? text(id) : before.find(id)->name));
  return {};
}

Result<Document> perform(const Document& before, const DrawBand& op, Context& context) {
  const double sewn = lengthOf(before, op.of) * op.ratio;
  Outline outline = rectangleOf(sewn + op.extra, op.depth, op.edges);
  // What is added beyond the seam is an edge of its own.
  const std::string lap = op.edges[0] + "_lap";
  if (op.extra > 1e-3) {
    const Curve low = outline.edges[0].curve;
    const Flat end{low.start.u + sewn, 0};
    outline.edges[0].curve = Curve::line(low.start, end);
    outline.edges.insert(outline.edges.begin() + 1, {lap, Curve::line(end, low.end)});
  }
  auto piece = newPiece(before, {op.name, op.fabric, op.layer}, std::move(outline));
  if (!piece) return piece.error();
  if (!op.sew) return withPiece(before, *std::move(piece));

  BodyPtr body;
  if (before.body.chosen()) {
    auto found = bodyOf(before, context);
    if (!found) return found.error();
    body = *found;
  }
  const SpaceRun run = runOf(before, op.of);
  const PieceId id = piece->id;
  auto stood = ledTo(before, *std::move(piece), op.edges[0], run,
                     {op.turn, op.turned, op.clear == Choice::Yes, false, op.wrap}, body.get(), op.round);
  if (!stood) return stood.error();
  Document after = withPiece(before, *std::move(stood));
  Seam seam;
  seam.id = mint<SeamId>(before, 0);
  seam.a = {{id, op.edges[0], 0, 1}};
  seam.reversed = !op.turned;
  for (const EdgeRef& edge : op.of) {
    seam.b.push_back({edge.piece.id, edge.edge, edge.from, edge.to});
    after.drape.dirty.insert(edge.piece.id);
  }
  if (op.ratio < 0.7 || op.ratio > 1.4) seam.tie = Seam::Tie::TwoToOne;
  after.pattern.seams[seam.id] = seam;
  if (op.eased == Choice::Yes && op.ratio != 1) after.eases[seam.id] = std::abs(op.ratio - 1) * lengthOf(before, op.of);
  const bool closed = run.closed && op.extra <= 1e-3 && op.wrap.empty() && op.joined != Choice::No;
  tellShut(before, op, closed, context);
  if (!closed) return after;
  Seam ends;
  ends.id = mint<SeamId>(before, 1);
  ends.a = {{id, op.edges[1], 0, 1}};
  ends.b = {{id, op.edges[3], 0, 1}};
  after.pattern.seams[ends.id] = std::move(ends);
  return after;
}

}  // namespace karinui
