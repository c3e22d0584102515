// Elastics, of edges and inner lines, and hems.
#include <algorithm>
#include <cmath>

#include "design/operations/finished_edges.h"
#include "design/operations/said.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/trims.h"

namespace karinui {

namespace {

// Of the elastic. Where the pieces named are sewn to rings, as a sleeve is, and not to their symmetric copies, each
// copy has one of its own, as long; else one goes on along all.
double lengthOf(const Document& document, const std::set<Allowances::At>& edges, const std::vector<EdgeRef>& named) {
  std::set<PieceId> own, sewnToOwn;
  for (const EdgeRef& edge : named) own.insert(edge.piece.id);
  bool closed = false;
  for (const auto& [id, seam] : document.pattern.seams) {
    std::set<PieceId> pieces;
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) pieces.insert(span.piece);
    if (std::none_of(pieces.begin(), pieces.end(), [&](PieceId piece) { return own.contains(piece); })) continue;
    sewnToOwn.insert(pieces.begin(), pieces.end());
    closed = closed || std::includes(own.begin(), own.end(), pieces.begin(), pieces.end());
  }
  double whole = 0;
  const bool each = closed && std::none_of(edges.begin(), edges.end(), [&](const Allowances::At& at) {
                      return !own.contains(at.first) && sewnToOwn.contains(at.first);
                    });
  for (const auto& [piece, name] : edges)
    if (!each || own.contains(piece)) whole += findCurve(*document.find(piece), name)->length();
  return whole;
}

// The lines on which the further rows of an edge's elastic lie.
std::set<Allowances::At> rowsOf(const Document& document, const Allowances::At& edge) {
  std::set<Allowances::At> rows;
  for (int row = 2; row <= kMostRows; ++row)
    if (const Allowances::At at{edge.first, elasticRowName(edge.second, row)};
        document.allowances.elastics.contains(at))
      rows.insert(at);
  return rows;
}

Document withoutRows(Document document, const Allowances::At& edge) {
  const std::set<Allowances::At> rows = rowsOf(document, edge);
  if (rows.empty()) return document;
  Piece piece = *document.find(edge.first);
  std::erase_if(piece.lines, [&](const InternalLine& line) { return rows.contains({piece.id, line.name}); });
  for (const Allowances::At& at : rows) document.allowances.elastics.erase(at);
  return withPiece(std::move(document), std::move(piece));
}

Result<Document> withRows(Document document, const Allowances::At& edge, int rows, double spacing) {
  Piece piece = *document.find(edge.first);
  for (int row = 2; row <= rows; ++row) {
    const auto curve = parallelInside(piece, edge.second, spacing * (row - 1));
    if (!curve) return refused(say("“{0}” has no room for {1} rows beside “{2}”.", piece.name, rows, edge.second));
    const std::string name = elasticRowName(edge.second, row);
    if (findEdge(piece, name) || std::any_of(piece.lines.begin(), piece.lines.end(),
                                             [&](const InternalLine& line) { return line.name == name; }))
      return refused(say("“{0}” has a line “{1}” already; erase or rename it first.", piece.name, name));
    piece.lines.push_back({name, {*curve}, {}});
    document.allowances.elastics[{piece.id, name}] = document.allowances.elastics[edge];
  }
  return withPiece(std::move(document), std::move(piece));
}

constexpr double kShirred = 0.01;  // metres from row to row, where none is said

}  // namespace

Done resolve(const Document& before, SewElastic& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges the elastic is sewn to: edges=skirt.waist."));
  if (op.ratio && op.length) return refused(say("Say the elastic's ratio or its length, not both."));
  if ((op.rows && !(*op.rows >= 1 && *op.rows <= kMostRows)) ||
      (op.spacing && !(*op.spacing >= 0.003 && *op.spacing <= 0.1)))
    return refused(say("Elastic is sewn in 1 to {0} rows, 3 to 100 mm apart.", kMostRows));
  if (op.spacing && !op.rows) return refused(say("Say how many rows lie so far apart: rows=5 spacing=1cm."));
  if (op.none && (op.ratio || op.length || op.strength || op.rows))
    return refused(say("An elastic that is taken out has no ratio, length or strength."));
  if (op.ratio && !(*op.ratio >= kTightestElastic && *op.ratio <= kLoosestElastic))
    return refused(say("The elastic is {0} to {1} times as long as the edge.", kTightestElastic, kLoosestElastic));
  if (op.strength && !(*op.strength >= kWeakestElastic && *op.strength <= kStrongestElastic))
    return refused(say("An elastic pulls with {0} to {1} N when it is drawn out by half; usual are 3 to 30 N.",
                       kWeakestElastic, kStrongestElastic));
  if (Done done = resolveFinishedLines(before, op.edges, op.symmetric, context); !done) return done;
  const std::set<Allowances::At> edges = finishedPlaces(before, op.edges, op.symmetric);
  for (const auto& at : edges)
    if (op.rows && !findEdge(*before.find(at.first), at.second))
      return refused(say("“{0}” is an inner line; rows are drawn beside an edge.", at.second));
  if (op.none) {
    for (const auto& at : edges)
      if (before.allowances.elastics.contains(at)) return {};
    return refused(say("There is no elastic along “{0}”.", op.edges.front().edge));
  }
  if (!op.length) return {};
  const double whole = lengthOf(withOneCurveEach(before, edges), edges, op.edges);
  if (!(*op.length >= kTightestElastic * whole && *op.length <= kLoosestElastic * whole))
    return refused(say("The edges are {0} cm long together; the elastic for them is cut {1} to {2} cm long.",
                       centimetres(whole), centimetres(kTightestElastic * whole),
                       centimetres(kLoosestElastic * whole)));
  return {};
}

Result<Document> perform(const Document& before, const SewElastic& op, Context&) {
  const std::set<Allowances::At> edges = finishedPlaces(before, op.edges, op.symmetric);
  Document after = withOneCurveEach(before, edges);
  const double whole = lengthOf(after, edges, op.edges);
  for (const auto& at : edges) {
    if (op.none) {
      after = withoutRows(std::move(after), at);
      after.allowances.elastics.erase(at);
      continue;
    }
    if (op.rows) after = withoutRows(std::move(after), at);
    std::set<Allowances::At> rows = rowsOf(after, at);
    rows.insert(at);
    for (const Allowances::At& row : rows) {
      Elastic& elastic = after.allowances.elastics[row];  // what is not said stays as it was
      if (op.ratio) elastic.ratio = *op.ratio;
      if (op.length) elastic.ratio = *op.length / whole;
      if (op.strength) elastic.strength = *op.strength;
    }
    if (!op.rows) continue;
    auto drawn = withRows(std::move(after), at, *op.rows, op.spacing.value_or(Length{kShirred}));
    if (!drawn) return drawn;
    after = *std::move(drawn);
  }
  return disturbed(std::move(after), edges);
}

Done resolve(const Document& before, TurnHem& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are turned up: edges=skirt.hem."));
  if (!op.none && !sound(Hem{op.width, op.under}))
    return refused(say("A hem is 3 to 100 mm deep together with what is turned in, which is no deeper than the hem."));
  if (Done done = resolveFinished(before, op.edges, op.symmetric, context); !done) return done;
  for (const auto& at : finishedPlaces(before, op.edges, op.symmetric)) {
    if (op.none && !before.allowances.hems.contains(at)) return refused(say("“{0}” is not turned up.", at.second));
    if (!op.none && (before.allowances.bindings.contains(at) || before.allowances.pipings.contains(at)))
      return refused(say("“{0}” is bound or piped; take that out first.", at.second));
    if (!op.none && heldBySeam(before, at))
      return refused(say("“{0}” is sewn to another edge; only a free edge is turned up.", at.second));
  }
  return {};
}

Result<Document> perform(const Document& before, const TurnHem& op, Context&) {
  Document after = before;
  const std::set<Allowances::At> edges = finishedPlaces(before, op.edges, op.symmetric);
  for (const auto& at : edges) {
    const auto& all = after.find(at.first)->outline.edges;
    const std::size_t k = *after.find(at.first)->outline.find(at.second);
    const Allowances::At next{at.first, all[(k + 1) % all.size()].name};
    Allowances& own = after.allowances;
    if (op.none) {
      own.hems.erase(at), own.edges.erase(at), own.corners.erase(at), own.corners.erase(next);
      continue;
    }
    own.hems[at] = {op.width, op.under};
    own.edges[at] = own.hems[at].allowance();
    // Turned up, its ends lie on what they cover.
    own.corners[at] = CornerKind::MirrorAfter, own.corners[next] = CornerKind::MirrorBefore;
  }
  return disturbed(std::move(after), edges);
}

}  // namespace karinui
