// A strap over a shoulder or round the neck: measured along the body, stood there and sewn at both ends.
#include <algorithm>
#include <cmath>

#include "design/operations/new_piece.h"
#include "design/operations/sewn_runs.h"
#include "design/operations/strap_way.h"
#include "design/spoken.h"
#include "karinui/design/sewing.h"

namespace karinui {

namespace {

constexpr double kNarrowestStrap = 0.002, kWidestStrap = 0.3;  // metres
constexpr double kLongestStrap = 3, kMostStrapEase = 0.5;      // metres

// The part of an edge that a strap of that width takes, about the middle of the part that is named.
Done widen(const Document& before, EdgeRef& part, double width) {
  const double whole = lengthOf(before, {{part.piece, part.edge}});
  if (width > whole + 1e-6)
    return refused(say("{0} is {1} mm long; a strap that is {2} mm wide does not go onto it.",
                       spoken(before, {part.piece, part.edge}), written(std::round(whole * 1e4) / 10),
                       written(std::round(width * 1e4) / 10)));
  const double share = std::fmin(width / whole, 1);
  double from = std::clamp((part.from + part.to) / 2 - share / 2, 0.0, 1 - share);
  from = std::round(from * 1e5) / 1e5;  // to be read in a record
  part.from = from, part.to = std::fmin(1, std::round((from + share) * 1e5) / 1e5);
  return {};
}

Seam endSeam(const Document& before, std::uint32_t nth, EdgeSpan own, const EdgeRef& to, bool reversed) {
  Seam seam;
  seam.id = mint<SeamId>(before, nth);
  seam.a = {std::move(own)};
  seam.b = spansOf({to});
  seam.reversed = reversed;
  return seam;
}

}  // namespace

Done resolve(const Document& given, DrawStrap& op, Context& context) {
  if (Done done = checkPaper(given, {op.name, op.fabric, op.layer}); !done) return done;
  for (EdgeRef* part : {&op.from, &op.to})
    if (Done done = resolveSewn(given, *part); !done) return done;
  const Document before = withOneCurve(given, {op.from}, {op.to});
  if (op.width && !(*op.width >= kNarrowestStrap && *op.width <= kWidestStrap))
    return refused(say("A strap is between 2 mm and 30 cm wide."));
  for (EdgeRef* part : {&op.from, &op.to}) {
    if (op.width && !context.recorded)
      if (Done done = widen(before, *part, *op.width); !done) return done;
    if (const double wide = lengthOf(before, {*part}); !(wide >= kNarrowestStrap && wide <= kWidestStrap))
      return refused(say("A strap that takes all of {0} would be {1} cm wide; say its width: width=2cm.",
                         spoken(before, *part), written(std::round(wide * 1e3) / 10)));
    if (lineOf(before, *part)) continue;  // to a line several things can be sewn
    for (const SeamId id : seamsOn(before, {*part}))
      return refused(say("{0} is already sewn by seam {1}; take that out first.", spoken(before, *part),
                         spoken(*before.find(id))));
  }
  if (overlap(op.from, op.to)) return refused(say("A strap begins and ends at different places."));
  if (op.length && !(*op.length >= kNarrowestStrap && *op.length <= kLongestStrap))
    return refused(say("A strap is between 2 mm and 3 m long."));
  if (op.length && op.ease != 0)
    return refused(say("A strap whose length is given has no ease; say only one of them."));
  if (!(std::fabs(op.ease) <= kMostStrapEase)) return refused(say("The ease of a strap lies between -50 and 50 cm."));
  if (op.edges.empty()) op.edges = {"low", "side_right", "top", "side_left"};
  if (op.edges.size() != 4)
    return refused(say("This shape has {0} {0|edge|edges}; it got {1} {1|name|names}.", 4, op.edges.size()));
  return settleWay(before, strapEnd(before, op.from), strapEnd(before, op.to), op.over, context);
}

Result<Document> perform(const Document& given, const DrawStrap& op, Context& context) {
  const Document before = withOneCurve(given, {op.from}, {op.to});
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  const StrapEnd from = strapEnd(before, op.from), to = strapEnd(before, op.to);
  const auto way = strapWay(before, {}, **body, from, to, op.over);
  if (!way) return way.error();
  const double length = op.length ? op.length->metres : way->length + op.ease;
  if (!(length >= kNarrowestStrap))
    return refused(say("The way over the body is {0} cm; with that ease nothing is left of the strap.",
                       written(std::round(way->length * 1e3) / 10)));
  const double low = lengthOf(before, {op.from}) / 2, top = lengthOf(before, {op.to}) / 2;
  const Flat corners[] = {{-low, 0}, {low, 0}, {top, length}, {-top, length}};
  Outline outline;
  for (std::size_t k = 0; k < 4; ++k)
    outline.edges.push_back({op.edges[k], Curve::line(corners[k], corners[(k + 1) % 4])});
  auto piece = newPiece(before, {op.name, op.fabric, op.layer}, std::move(outline));
  if (!piece) return piece.error();
  const PieceId id = piece->id;
  auto laid = laidAlong(before, *std::move(piece), {0, 0}, {0, length}, *way, **body);
  if (!laid) return laid.error();
  Document after = withPiece(before, *std::move(laid));
  // Its low end runs across the way to the right, its top to the left.
  const Seam seams[] = {endSeam(before, 0, {id, op.edges[0], 0, 1}, op.from, dot(from.along, way->across.front()) < 0),
                        endSeam(before, 1, {id, op.edges[2], 0, 1}, op.to, dot(to.along, way->across.back()) > 0)};
  for (const Seam& seam : seams) after.pattern.seams[seam.id] = seam;
  for (const EdgeRef* part : {&op.from, &op.to}) after.drape.dirty.insert(part->piece.id);
  return after;
}

}  // namespace karinui
