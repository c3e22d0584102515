// Elastics, of edges and inner lines, and hems.
#include <cmath>

#include "design/operations/finished_edges.h"
#include "design/operations/sewn_runs.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

// The line that lies where the image of one does, on the same piece or on its mirror image.
const InternalLine* imageOf(const InternalLine& line, const Piece& on, const std::function<Flat(Flat)>& image) {
  constexpr double kSame = 1e-5;  // metres
  const Flat start = image(line.curves.front().start), end = image(line.curves.back().end);
  for (const InternalLine& other : on.lines) {
    if (other.curves.empty()) continue;
    const Flat from = other.curves.front().start, to = other.curves.back().end;
    if ((distance(from, start) < kSame && distance(to, end) < kSame) ||
        (distance(from, end) < kSame && distance(to, start) < kSame))
      return &other;
  }
  return nullptr;
}

struct Named {
  std::vector<EdgeRef> edges, lines;
};
Named parted(const Document& document, const std::vector<EdgeRef>& named) {
  Named parts;
  for (const EdgeRef& ref : named) (lineOf(document, ref) ? parts.lines : parts.edges).push_back(ref);
  return parts;
}

// A line's image on the piece's other half.
const InternalLine* onOtherHalf(const Document& document, const EdgeRef& ref) {
  const Piece& piece = *document.find(ref.piece.id);
  const auto symmetry = symmetryOf(piece.outline);
  return symmetry ? imageOf(*lineOf(document, ref), piece, [&](Flat p) { return symmetry->image(p); }) : nullptr;
}

std::set<Allowances::At> places(const Document& document, const std::vector<EdgeRef>& named, Choice symmetric) {
  std::set<Allowances::At> all;
  const auto [edges, lines] = parted(document, named);
  for (const FinishedEdge& edge : finishedEdges(document, edges, symmetric == Choice::Yes))
    all.insert({edge.piece, document.find(edge.piece)->outline.edges[edge.edge].name});
  for (EdgeRef ref : lines) {
    std::vector<std::string> own{ref.edge};
    if (symmetric == Choice::Yes)
      if (const InternalLine* other = onOtherHalf(document, ref)) own.push_back(other->name);
    for (const std::string& name : own) {
      all.insert({ref.piece.id, name});
      ref.edge = name;
      for (const PieceId id : likenesses(document, ref.piece.id))
        if (const InternalLine* other = imageOf(*lineOf(document, ref), *document.find(id), [](Flat p) {
              return Flat{-p.u, p.v};
            }))
          all.insert({id, other->name});
    }
  }
  return all;
}

double lengthOf(const Document& document, const std::set<Allowances::At>& edges) {
  double whole = 0;
  for (const auto& [piece, name] : edges) whole += findCurve(*document.find(piece), name)->length();
  return whole;
}

Document withOneCurve(Document document, const std::set<Allowances::At>& edges) {
  std::vector<EdgeRef> refs;
  for (const auto& [piece, name] : edges) refs.push_back({PieceRef(piece), name, 0, 1});
  return withOneCurve(std::move(document), refs, {});
}

// Edges and inner lines, whole. Auto is decided.
Done resolveElastic(const Document& before, std::vector<EdgeRef>& named, Choice& symmetric, Context& context) {
  for (EdgeRef& ref : named) {
    ref.from = 0, ref.to = 1;
    if (Done done = resolveSewn(before, ref); !done) return done;
  }
  auto [edges, lines] = parted(before, named);
  const bool both = symmetric != Choice::No && std::any_of(lines.begin(), lines.end(), [&](const EdgeRef& ref) {
                      return onOtherHalf(before, ref) != nullptr;
                    });
  if (!edges.empty() && !both) return resolveFinished(before, edges, symmetric, context);
  if (symmetric == Choice::Yes && !both)
    return refused(
        say("Piece {0} is not symmetric; leave symmetric= away.", before.find(lines.front().piece.id)->name));
  symmetric = both ? Choice::Yes : Choice::No;
  return {};
}

// Cloth that was at rest is no longer.
Document disturbed(Document document, const std::set<Allowances::At>& edges) {
  std::set<PieceId> pieces;
  for (const auto& [piece, name] : edges) pieces.insert(piece);
  for (const PieceId piece : pieces) document = withPiece(std::move(document), *document.find(piece));
  return document;
}

std::string centimetres(double metres) { return fixed(100 * metres, 1); }

}  // namespace

Done resolve(const Document& before, SewElastic& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges the elastic is sewn to: edges=skirt.waist."));
  if (op.ratio && op.length) return refused(say("Say the elastic's ratio or its length, not both."));
  if (op.none && (op.ratio || op.length || op.strength))
    return refused(say("An elastic that is taken out has no ratio, length or strength."));
  if (op.ratio && !(*op.ratio >= kTightestElastic && *op.ratio <= kLoosestElastic))
    return refused(say("The elastic is {0} to {1} times as long as the edge.", kTightestElastic, kLoosestElastic));
  if (op.strength && !(*op.strength >= kWeakestElastic && *op.strength <= kStrongestElastic))
    return refused(say("An elastic pulls with {0} to {1} N when it is drawn out by half; usual are 3 to 30 N.",
                       kWeakestElastic, kStrongestElastic));
  if (Done done = resolveElastic(before, op.edges, op.symmetric, context); !done) return done;
  const std::set<Allowances::At> edges = places(before, op.edges, op.symmetric);
  if (op.none) {
    for (const auto& at : edges)
      if (before.allowances.elastics.contains(at)) return {};
    return refused(say("There is no elastic along “{0}”.", op.edges.front().edge));
  }
  if (!op.length) return {};
  const double whole = lengthOf(withOneCurve(before, edges), edges);
  if (!(*op.length >= kTightestElastic * whole && *op.length <= kLoosestElastic * whole))
    return refused(say("The edges are {0} cm long together; the elastic for them is cut {1} to {2} cm long.",
                       centimetres(whole), centimetres(kTightestElastic * whole),
                       centimetres(kLoosestElastic * whole)));
  return {};
}

Result<Document> perform(const Document& before, const SewElastic& op, Context&) {
  const std::set<Allowances::At> edges = places(before, op.edges, op.symmetric);
  Document after = withOneCurve(before, edges);
  for (const auto& at : edges) {
    if (op.none) {
      after.allowances.elastics.erase(at);
      continue;
    }
    Elastic& elastic = after.allowances.elastics[at];  // what is not said stays as it was
    if (op.ratio) elastic.ratio = *op.ratio;
    if (op.length) elastic.ratio = *op.length / lengthOf(after, edges);
    if (op.strength) elastic.strength = *op.strength;
  }
  return disturbed(std::move(after), edges);
}

Done resolve(const Document& before, TurnHem& op, Context& context) {
  if (op.edges.empty()) return refused(say("Say which edges are turned up: edges=skirt.hem."));
  if (!op.none && !sound(Hem{op.width, op.under}))
    return refused(say("A hem is 3 to 100 mm deep together with what is turned in, which is no deeper than the hem."));
  if (Done done = resolveFinished(before, op.edges, op.symmetric, context); !done) return done;
  for (const auto& at : places(before, op.edges, op.symmetric)) {
    if (op.none && !before.allowances.hems.contains(at)) return refused(say("“{0}” is not turned up.", at.second));
    for (const auto& [id, seam] : before.pattern.seams)
      for (const auto* side : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *side)
          if (!op.none && span.piece == at.first && span.edge == at.second)
            return refused(say("“{0}” is sewn to another edge; only a free edge is turned up.", at.second));
  }
  return {};
}

Result<Document> perform(const Document& before, const TurnHem& op, Context&) {
  Document after = before;
  const std::set<Allowances::At> edges = places(before, op.edges, op.symmetric);
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
