#include "design/operations/pocket_follows.h"

#include <array>
#include <cmath>

#include "design/operations/pocket_bag.h"
#include "design/operations/recut_outline.h"
#include "karinui/pattern/pockets.h"

namespace karinui {

namespace {

using EdgesAnew = std::map<std::string, Curve>;

constexpr double kOnPaper = 1e-4, kMoved = 1e-7;  // metres

bool onOneLine(const Curve& a, const Curve& b, double apart) {
  return distance(a.start, b.start) < apart && distance(a.end, b.end) < apart && distance(a.at(0.5), b.at(0.5)) < apart;
}

const Curve* curveUnder(const Pattern& pattern, const EdgeSpan& span) {
  const auto piece = pattern.pieces.find(span.piece);
  return piece == pattern.pieces.end() ? nullptr : findCurve(*piece->second, span.edge);
}

bool isWhole(const EdgeSpan& span) { return span.from == 0 && span.to == 1; }

std::optional<Curve> spanOf(const Pattern& pattern, const EdgeSpan& span) {
  const Curve* whole = curveUnder(pattern, span);
  if (!whole) return std::nullopt;
  return isWhole(span) ? *whole : curvePart(*whole, span.from, span.to);
}

std::array<PieceId, 2> piecesOf(const Pattern& pattern, const SewnPocket& pocket) {
  const Seam& round = pattern.seams.at(pocket.round);
  return {round.a.front().piece, round.b.front().piece};
}

// Edges (and lines) of a piece that lie on a part of another's edge, and are sewn to it there.
struct HungEdge {
  SeamId seam;
  std::size_t at = 0;  // of the seam's spans
};
std::vector<HungEdge> hungEdges(const Pattern& pattern, PieceId piece) {
  std::vector<HungEdge> hung;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.reversed || seam.a.size() != seam.b.size()) continue;
    for (std::size_t i = 0; i < seam.b.size(); ++i) {
      const EdgeSpan &outer = seam.a[i], &own = seam.b[i];
      if (own.piece != piece || outer.piece == piece || !isWhole(own)) continue;
      const bool line = !findEdge(*pattern.pieces.at(piece), own.edge);
      if (line != (seam.tie != Seam::Tie::Pleat)) continue;
      const auto behind = spanOf(pattern, outer);
      if (behind && onOneLine(*behind, *curveUnder(pattern, own), kOnPaper)) hung.push_back({id, i});
    }
  }
  return hung;
}

// What a piece's edges become where those moved behind which they hang.
EdgesAnew edgesAnew(const Document& before, const Document& after, PieceId piece) {
  EdgesAnew anew;
  for (const HungEdge& hung : hungEdges(before.pattern, piece)) {
    const Seam* seam = after.find(hung.seam);
    if (!seam || seam->a.size() <= hung.at || seam->b.size() <= hung.at) continue;
    const EdgeSpan& own = seam->b[hung.at];
    const auto behind = spanOf(after.pattern, seam->a[hung.at]);
    const Curve* is = own.piece == piece && isWhole(own) ? curveUnder(after.pattern, own) : nullptr;
    if (behind && is && !onOneLine(*behind, *is, kMoved)) anew[own.edge] = *behind;
  }
  return anew;
}

// Carried along by its ends, what is between as much as it is nearer to the one or the other.
Curve carriedByEnds(const Curve& curve, Flat start, Flat end) {
  const Flat first = start - curve.start, last = end - curve.end;
  if (curve.kind == Curve::Kind::Line) return Curve::line(start, end);
  std::vector<Curve> parts = curve.cubics();
  const auto n = static_cast<double>(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto by = [&](double t) { return lerp(first, last, (static_cast<double>(i) + t) / n); };
    Curve& part = parts[i];
    part = Curve::cubic(part.start + by(0), part.control1 + by(1.0 / 3), part.control2 + by(2.0 / 3), part.end + by(1));
  }
  parts.front().start = start, parts.back().end = end;
  return Curve::joined(parts);
}

Outline joinedAgain(Outline outline, const EdgesAnew& anew) {
  const std::size_t n = outline.edges.size();
  const auto freshOf = [&](std::size_t k) {
    const auto found = anew.find(outline.edges[k % n].name);
    return found == anew.end() ? nullptr : &found->second;
  };
  std::vector<Flat> corners;  // where each edge starts
  for (std::size_t k = 0; k < n; ++k) {
    const Curve *own = freshOf(k), *last = freshOf(k + n - 1);
    corners.push_back(own ? own->start : last ? last->end : outline.edges[k].curve.start);
  }
  for (std::size_t k = 0; k < n; ++k) {
    Curve& curve = outline.edges[k].curve;
    if (const Curve* own = freshOf(k)) curve = *own;
    if (curve.start != corners[k] || curve.end != corners[(k + 1) % n])
      curve = carriedByEnds(curve, corners[k], corners[(k + 1) % n]);
  }
  return outline;
}

// The bags of one pocket, or bag and side piece. False: they cannot be cut so.
bool followBoth(const Document& before, Document& after, const std::array<PieceId, 2>& both) {
  std::array<EdgesAnew, 2> anew{edgesAnew(before, after, both[0]), edgesAnew(before, after, both[1])};
  if (anew[0].empty() && anew[1].empty()) return true;
  const std::size_t first = anew[0].size() >= anew[1].size() ? 0 : 1;
  for (const std::size_t k : {first, 1 - first}) {
    const Piece old = *after.find(both[k]);
    if (k != first)  // what was one line with the other's edge stays that
      for (const Edge& edge : before.find(both[k])->outline.edges)
        for (const Edge& other : before.find(both[first])->outline.edges)
          if (!anew[k].contains(edge.name) && onOneLine(edge.curve, other.curve, kOnPaper))
            if (const Edge* is = findEdge(*after.find(both[first]), other.name)) anew[k][edge.name] = is->curve;
    auto outline = checked(joinedAgain(old.outline, anew[k]));
    if (!outline) return false;
    Document next = cutAlone(after, old, *outline);
    Piece piece = *next.find(both[k]);
    for (InternalLine& line : piece.lines)
      if (const auto on = anew[k].find(line.name); on != anew[k].end() && !findEdge(piece, line.name))
        line.curves = {on->second};
    after = withPiece(std::move(next), std::move(piece));
  }
  return true;
}

}  // namespace

Document pocketsFollowed(const Document& before, Document after, const Context& context) {
  for (const SewnPocket& pocket : pocketsOf(before.pattern)) {
    const auto both = piecesOf(before.pattern, pocket);
    if (!after.find(both[0]) || !after.find(both[1])) continue;
    if (!followBoth(before, after, both) && context.advise)
      context.advise({say("“{0}” and “{1}” cannot follow the edges they hang behind: change the step of their pocket.",
                          after.find(both[0])->name, after.find(both[1])->name)});
  }
  return after;
}

std::set<SeamId> seamsOfPockets(const Pattern& pattern) {
  std::set<SeamId> seams;
  for (const SewnPocket& pocket : pocketsOf(pattern)) {
    seams.insert(pocket.round);
    seams.insert(pocket.caught.begin(), pocket.caught.end());
    for (const PieceId piece : piecesOf(pattern, pocket))
      for (const HungEdge& hung : hungEdges(pattern, piece)) seams.insert(hung.seam);
  }
  return seams;
}

std::vector<EdgeRef> beyondPockets(const Pattern& pattern, const EdgeRef& edge) {
  for (const SewnPocket& pocket : pocketsOf(pattern))
    for (const PieceId piece : piecesOf(pattern, pocket)) {
      const auto& edges = pattern.pieces.at(piece)->outline.edges;
      std::map<std::size_t, const EdgeSpan*> behind;
      for (const HungEdge& hung : hungEdges(pattern, piece)) {
        const Seam& seam = pattern.seams.at(hung.seam);
        if (const auto k = pattern.pieces.at(piece)->outline.find(seam.b[hung.at].edge)) behind[*k] = &seam.a[hung.at];
      }
      const Seam& round = pattern.seams.at(pocket.round);
      const auto inner = [&](std::size_t k) {
        const auto own = [&](const EdgeSpan& span) { return span.piece == piece && span.edge == edges[k].name; };
        return std::any_of(round.a.begin(), round.a.end(), own) || std::any_of(round.b.begin(), round.b.end(), own);
      };
      for (const auto& [k, outer] : behind)
        for (const std::size_t next : {k + 1, k + edges.size() - 1}) {
          const std::size_t beyond = next % edges.size();
          if (behind.contains(beyond) || inner(beyond)) continue;
          std::vector<EdgeRef> all{{PieceRef(outer->piece), outer->edge},
                                   {PieceRef(piece), edges[k].name},
                                   {PieceRef(piece), edges[beyond].name}};
          const auto own = std::find_if(all.begin(), all.end(), [&](const EdgeRef& one) {
            return one.piece.id == edge.piece.id && one.edge == edge.edge;
          });
          if (own == all.end()) continue;
          all.erase(own);
          return all;
        }
    }
  return {};
}

}  // namespace karinui
