#include "design/operations/finished_edges.h"

#include "design/operations/sewn_runs.h"

namespace karinui {

namespace {

Flat middleOf(const InternalLine& line) {
  double whole = 0;
  for (const Curve& curve : line.curves) whole += curve.length();
  double left = whole / 2;
  for (const Curve& curve : line.curves) {
    const double own = curve.length();
    if (left <= own) return curve.at(curve.parameterAt(left));
    left -= own;
  }
  return line.curves.back().end;
}

// The line that lies where the image of one does, on the same piece or on its mirror image.
const InternalLine* imageOf(const InternalLine& line, const Piece& on, const std::function<Flat(Flat)>& image) {
  constexpr double kSame = 1e-5, kSameMiddle = 1e-4;  // metres
  const Flat start = image(line.curves.front().start), end = image(line.curves.back().end);
  for (const InternalLine& other : on.lines) {
    if (other.curves.empty()) continue;
    const Flat from = other.curves.front().start, to = other.curves.back().end;
    const bool there = distance(from, start) < kSame && distance(to, end) < kSame,
               back = distance(from, end) < kSame && distance(to, start) < kSame;
    // Two curves between the same ends are two lines, as those of a dart within a piece.
    if ((there || back) && distance(middleOf(other), image(middleOf(line))) < kSameMiddle) return &other;
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

}  // namespace

const InternalLine* lineOnCopy(const InternalLine& line, const Piece& copy) {
  return imageOf(line, copy, [](Flat p) { return Flat{-p.u, p.v}; });
}

std::vector<FinishedEdge> finishedEdges(const Document& document, const std::vector<EdgeRef>& named, bool bothHalves) {
  std::vector<FinishedEdge> all;
  for (const EdgeRef& ref : named) {
    const Piece& piece = *document.find(ref.piece.id);
    const std::size_t edge = *piece.outline.find(ref.edge);
    all.push_back({piece.id, edge, false});
    if (!bothHalves) continue;
    if (const auto symmetry = symmetryOf(piece.outline))
      if (const auto partner = symmetry->partner[edge]; partner && *partner != edge)
        all.push_back({piece.id, *partner, true});
  }
  // A symmetric copy follows the piece it is the copy of, and the piece its copy.
  for (const FinishedEdge& own : std::vector<FinishedEdge>(all)) {
    const Piece& piece = *document.find(own.piece);
    const Outline image = mirrored(piece).outline;
    for (const auto& [id, other] : document.pattern.pieces)
      if (id != piece.id && (other->mirrorOf == piece.id || piece.mirrorOf == id))
        if (const auto edge = other->outline.find(image.edges[image.edges.size() - 1 - own.edge].name))
          all.push_back({id, *edge, !own.back});
  }
  return all;
}

Done resolveFinished(const Document& before, std::vector<EdgeRef>& edges, Choice& symmetric, Context& context) {
  bool any = false;
  for (EdgeRef& edge : edges) {
    edge.from = 0, edge.to = 1;
    if (Done done = resolve(before, edge); !done) return done;
    const Piece& piece = *before.find(edge.piece.id);
    // Of several pieces it is enough that one is symmetric.
    Choice one = symmetric == Choice::No ? Choice::No : Choice::Auto;
    const auto both = [&](const PaperSymmetry& there) {
      return there.partner[*piece.outline.find(edge.edge)].has_value();
    };
    if (Done done = resolveSymmetric(piece, one, context, both); !done) return done;
    any = any || one == Choice::Yes;
    if (symmetric == Choice::Yes && !any && &edge == &edges.back())
      return resolveSymmetric(piece, symmetric, context, both);
  }
  symmetric = any ? Choice::Yes : Choice::No;
  return {};
}

bool heldBySeam(const Document& document, const Allowances::At& edge) {
  constexpr double kHeld = 0.5;  // of its length
  double sewn = 0;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (span.piece == edge.first && span.edge == edge.second) sewn += span.to - span.from;
  return sewn > kHeld;
}

std::set<Allowances::At> finishedPlaces(const Document& document, const std::vector<EdgeRef>& named, Choice symmetric) {
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
        if (const InternalLine* other = lineOnCopy(*lineOf(document, ref), *document.find(id)))
          all.insert({id, other->name});
    }
  }
  return all;
}

Done resolveFinishedLines(const Document& before, std::vector<EdgeRef>& named, Choice& symmetric, Context& context) {
  for (EdgeRef& ref : named) {
    ref.from = 0, ref.to = 1;
    if (Done done = resolve(before, ref.piece); !done) return done;
    if (Done done = lineOf(before, ref) ? resolveSewn(before, ref) : resolve(before, ref); !done) return done;
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

Document withOneCurveEach(Document document, const std::set<Allowances::At>& edges) {
  std::vector<EdgeRef> refs;
  for (const auto& [piece, name] : edges) refs.push_back({PieceRef(piece), name, 0, 1});
  return withOneCurve(std::move(document), refs, {});
}

Document disturbed(Document document, const std::set<Allowances::At>& edges) {
  std::set<PieceId> pieces;
  for (const auto& [piece, name] : edges) pieces.insert(piece);
  for (const PieceId id : pieces) {
    Piece piece = *document.find(id);
    document = withPiece(std::move(document), std::move(piece));
  }
  return document;
}

}  // namespace karinui
