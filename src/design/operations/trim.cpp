// Topstitching, piping and bindings.
#include "design/operations/finished_edges.h"

namespace karinui {

namespace {

template <class Op>
Done resolveEdges(const Document& before, Op& op, Context& context) {
  return resolveFinished(before, op.edges, op.symmetric, context);
}
Done resolveEdges(const Document& before, SewTopstitch& op, Context& context) {
  return resolveFinishedLines(before, op.edges, op.symmetric, context);
}

// What is taken out must be there.
template <class Finish>
Done resolveTaken(const std::map<Allowances::At, Finish>& all, const std::set<Allowances::At>& edges, Message missing) {
  for (const Allowances::At& at : edges)
    if (all.contains(at)) return {};
  return refused(std::move(missing));
}

// The edges that a seam holds to this one.
std::vector<Allowances::At> sewnTo(const Document& document, const Allowances::At& edge) {
  std::vector<Allowances::At> others;
  const auto on = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& s) { return s.piece == edge.first && s.edge == edge.second; });
  };
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto& [own, other] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
      if (on(*own))
        for (const EdgeSpan& span : *other) others.emplace_back(span.piece, span.edge);
  return others;
}

bool pipedFromTheOtherSide(const Document& document, const Allowances::At& edge) {
  const auto others = sewnTo(document, edge);
  return std::any_of(others.begin(), others.end(),
                     [&](const Allowances::At& other) { return document.allowances.pipings.contains(other); });
}

bool onLine(const Document& document, const Allowances::At& at) {
  return !findEdge(*document.find(at.first), at.second);
}

// What is not said stays as it was.
Topstitch withSaid(Topstitch own, const SewTopstitch& op) {
  if (op.offset) own.offset = *op.offset;
  if (op.rows) own.rows = *op.rows;
  if (op.apart) own.apart = *op.apart;
  if (op.length) own.length = *op.length;
  if (op.colour)
    own.colour = std::uint32_t{op.colour->red} << 16 | std::uint32_t{op.colour->green} << 8 | op.colour->blue;
  return own;
}
Piping withSaid(Piping own, const SewPiping& op) {
  if (op.thickness) own.thickness = *op.thickness;
  if (!op.fabric.empty()) own.fabric = op.fabric;
  return own;
}
Binding withSaid(Binding own, const BindEdges& op) {
  if (op.width) own.width = *op.width;
  if (!op.fabric.empty()) own.fabric = op.fabric;
  return own;
}
template <class Finish, class Op>
Finish finishAfter(const std::map<Allowances::At, Finish>& all, const Allowances::At& at, const Op& op) {
  const auto own = all.find(at);
  return withSaid(own == all.end() ? Finish() : own->second, op);
}

}  // namespace

Done resolve(const Document& before, SewTopstitch& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are topstitched: edges=front.hem."));
  if (op.none && (op.offset || op.rows || op.apart || op.length || op.colour))
    return refused(say("Topstitching that is taken out has no offset, rows, length or colour."));
  if (Done done = resolveEdges(before, op, context); !done) return done;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  const auto& all = before.allowances.topstitches;
  if (op.none) return resolveTaken(all, edges, say("“{0}” is not topstitched.", op.edges.front().edge));
  for (const auto& at : edges) {
    if (op.offset && onLine(before, at))
      return refused(
          say("“{0}” is an inner line: its rows lie evenly to both sides, so leave offset= away.", at.second));
    if (!sound(finishAfter(all, at, op)))
      return refused(
          say("Topstitching lies 0.5 to 100 mm inside the edge, in 1 to {0} rows 1 to 50 mm apart, its "
              "stitches 1 to 20 mm long.",
              kMostRows));
  }
  return {};
}

Result<Document> perform(const Document& before, const SewTopstitch& op, Context&) {
  Document after = before;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  auto& all = after.allowances.topstitches;
  for (const auto& at : edges) {
    if (op.none)
      all.erase(at);
    else
      all[at] = finishAfter(all, at, op);
  }
  return withOneCurveEach(std::move(after), edges);
}

Done resolve(const Document& before, SewPiping& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are piped: edges=front.neck."));
  if (op.none && (op.thickness || !op.fabric.empty()))
    return refused(say("Piping that is taken out has no thickness and no fabric."));
  if (!op.fabric.empty())
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  if (Done done = resolveEdges(before, op, context); !done) return done;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  const auto& all = before.allowances.pipings;
  if (op.none) return resolveTaken(all, edges, say("“{0}” is not piped.", op.edges.front().edge));
  for (const auto& at : edges) {
    if (!sound(finishAfter(all, at, op))) return refused(say("The cord of a piping is 1 to 20 mm thick."));
    if (before.allowances.bindings.contains(at) || before.allowances.hems.contains(at))
      return refused(say("“{0}” is bound or turned up; take that out first.", at.second));
    if (pipedFromTheOtherSide(before, at))
      return refused(say("“{0}” is sewn to an edge that is piped: one cord is enough.", at.second));
  }
  return {};
}

Result<Document> perform(const Document& before, const SewPiping& op, Context&) {
  Document after = before;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  auto& all = after.allowances.pipings;
  for (const auto& at : edges) {
    if (op.none)
      all.erase(at);
    else if (!pipedFromTheOtherSide(after, at))  // of a seam between two halves one is piped
      all[at] = finishAfter(all, at, op);
  }
  return disturbed(std::move(after), edges);
}

Done resolve(const Document& before, BindEdges& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are bound: edges=front.neck."));
  if (op.none && (op.width || !op.fabric.empty()))
    return refused(say("A binding that is taken off has no width and no fabric."));
  if (!op.fabric.empty())
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  if (Done done = resolveEdges(before, op, context); !done) return done;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  const auto& all = before.allowances.bindings;
  if (op.none) return resolveTaken(all, edges, say("“{0}” is not bound.", op.edges.front().edge));
  for (const auto& at : edges) {
    if (!sound(finishAfter(all, at, op))) return refused(say("A binding is 3 to 50 mm wide."));
    if (before.allowances.hems.contains(at))
      return refused(say("“{0}” is turned up; let the hem down first: hem edges=… none=yes.", at.second));
    if (before.allowances.pipings.contains(at))
      return refused(say("“{0}” is piped; take the piping out first: piping edges=… none=yes.", at.second));
    if (heldBySeam(before, at))
      return refused(say("“{0}” is sewn to another edge; only a free edge is bound.", at.second));
  }
  return {};
}

Result<Document> perform(const Document& before, const BindEdges& op, Context&) {
  Document after = before;
  const auto edges = finishedPlaces(before, op.edges, op.symmetric);
  Allowances& own = after.allowances;
  for (const auto& at : edges) {
    own.edges.erase(at);
    if (op.none) {
      own.bindings.erase(at);
      continue;
    }
    own.bindings[at] = finishAfter(own.bindings, at, op);
    own.edges[at] = 0;  // the strip takes the edge in
  }
  return disturbed(std::move(after), edges);
}

}  // namespace karinui
