// Corners of an outline: put on an edge, taken away, carried elsewhere; and darts, which are two and a tip.
#include <cmath>

#include "divide_edges.h"
#include "karinui/pattern/edit.h"
#include "refit_curve.h"
#include "words.h"

namespace karinui {

namespace {

// The outline or the hole that has an edge, and which of its edges that is.
struct Found {
  Outline* outline = nullptr;
  std::size_t edge = 0;
};
Found findIn(Piece& piece, std::string_view edge) {
  if (const auto k = piece.outline.find(edge)) return {&piece.outline, *k};
  for (Outline& hole : piece.holes)
    if (const auto k = hole.find(edge)) return {&hole, *k};
  return {};
}

// One curve in the place of two that follow each other, as documents of before have it: of two that meet at a corner
// only the outer directions are kept.
Curve oneCurve(const Curve& first, const Curve& second) {
  constexpr double kSmooth = 0.02;  // radians
  const Flat leaves = normalized(first.tangent(1)), arrives = normalized(second.tangent(0));
  const bool straight = first.kind == Curve::Kind::Line && second.kind == Curve::Kind::Line;
  if (straight) return Curve::line(first.start, second.end);
  if (std::fabs(angleFrom(leaves, arrives)) < kSmooth) return Curve::joined(std::vector<Curve>{first, second});
  const double handle = (first.length() + second.length()) / 3;
  return Curve::cubic(first.start, first.start + normalized(first.tangent(0)) * handle,
                      second.end - normalized(second.tangent(1)) * handle, second.end);
}

}  // namespace

Result<EditedPiece> splitEdge(const Piece& piece, std::string_view edge, double fraction) {
  EditedPiece edited{piece, {}};
  const auto [outline, k] = findIn(edited.piece, edge);
  if (!outline) return noEdge(piece, edge);
  const Curve& curve = outline->edges[k].curve;
  const double whole = curve.length();
  if (!(fraction * whole >= kLeastEdge && (1 - fraction) * whole >= kLeastEdge))
    return refused(say("Edge {0} is {1} mm long; a corner on it must stay 1 mm from both ends.", edge, inMm(whole)));
  divideEdges(*outline, {{k, curve.parameterAt(fraction * whole)}}, edgeNames(piece), piece.id, edited.edges);
  followMarks(edited.piece, edited.edges);
  return edited;
}

Result<EditedPiece> joinEdges(const Piece& piece, std::string_view edge, bool refit) {
  EditedPiece edited{piece, {}};
  const auto [outline, k] = findIn(edited.piece, edge);
  if (!outline) return noEdge(piece, edge);
  auto& edges = outline->edges;
  if (edges.size() < 3)
    return refused(say("The outline of {0} has only {1} {1|edge|edges}; it needs two.", piece.name, edges.size()));
  const std::size_t next = (k + 1) % edges.size();
  const double first = edges[k].curve.length(), share = first / (first + edges[next].curve.length());
  edited.edges[{piece.id, edges[k].name}] = {{0, 1, {piece.id, edges[k].name, 0, share}}};
  edited.edges[{piece.id, edges[next].name}] = {{0, 1, {piece.id, edges[k].name, share, 1}}};
  edges[k].curve = (refit ? refitted : oneCurve)(edges[k].curve, edges[next].curve);
  edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(next));
  auto good = checked(*outline);
  if (!good) return good.error();
  *outline = *std::move(good);
  followMarks(edited.piece, edited.edges);
  return edited;
}

Result<DartedPiece> addDart(const Piece& piece, std::string_view edge, double fraction, double width, Flat tip,
                            const std::string& name) {
  DartedPiece dart{{piece, {}}, {}, {}};
  Piece& now = dart.edited.piece;
  const auto k = now.outline.find(edge);
  if (!k) return noEdge(piece, edge);
  const Curve curve = now.outline.edges[*k].curve;
  const double whole = curve.length(), from = fraction * whole - width / 2, to = fraction * whole + width / 2;
  if (!(width >= kLeastEdge && from >= kLeastEdge && whole - to >= kLeastEdge))
    return refused(
        say("A dart {0} mm wide does not fit there on edge {1}, which is {2} mm long: it would open beyond "
            "its end. Put it farther in, or join the edge to the next one first.",
            inMm(width), edge, inMm(whole)));
  const Ring ring = now.outline.flattened(1e-4);
  if (!contains(ring, tip) || distanceToRing(ring, tip) < kLeastEdge)
    return refused(say("The dart's tip must lie inside {0}.", piece.name));
  auto taken = edgeNames(piece);
  EdgeMap& map = dart.edited.edges;
  divideEdges(now.outline, {{*k, curve.parameterAt(from)}, {*k, curve.parameterAt(to)}}, taken, piece.id, map);
  // The mouth is cut away; what is behind it takes its name.
  auto& edges = now.outline.edges;
  auto& parts = map.at({piece.id, std::string(edge)});
  edges[*k + 2].name = parts[2].now.edge = parts[1].now.edge;
  parts.erase(parts.begin() + 1);
  taken = edgeNames(now);
  dart.to = freeName(name, taken);
  dart.back = freeName(name, taken);
  Curve mouth = edges[*k + 1].curve;
  // Trued: the shorter side grows to the longer one's length, and the edge follows it, so that the two meet when sewn.
  const double side = distance(mouth.start, tip), other = distance(mouth.end, tip), longer = std::fmax(side, other);
  const auto grow = [&](Flat& corner, Curve& beside, Flat& end, Flat& control, double is) {
    const Flat grown = tip + (corner - tip) * (longer / is);
    if (beside.kind == Curve::Kind::Cubic) control += grown - end;  // a line has none to carry along
    corner = end = grown;
  };
  Curve &before = edges[*k].curve, &after = edges[*k + 2].curve;
  grow(mouth.start, before, before.end, before.control2, side);
  grow(mouth.end, after, after.start, after.control1, other);
  edges[*k + 1] = {dart.to, Curve::line(mouth.start, tip)};
  edges.insert(edges.begin() + static_cast<std::ptrdiff_t>(*k + 2), Edge{dart.back, Curve::line(tip, mouth.end)});
  const Ring wedge{mouth.start, mouth.end, tip};
  for (const Outline& hole : now.holes)
    for (const Flat p : hole.flattened(1e-3))
      if (contains(wedge, p)) return refused(say("The dart would run into a hole of {0}.", piece.name));
  auto good = checked(now.outline);
  if (!good) return good.error();
  now.outline = *std::move(good);
  followMarks(now, map);
  return dart;
}

Result<Piece> moveCorner(const Piece& piece, std::string_view edge, Flat to) {
  Piece moved = piece;
  const auto [outline, k] = findIn(moved, edge);
  if (!outline) return noEdge(piece, edge);
  Curve& after = outline->edges[k].curve;
  Curve& before = outline->edges[(k + outline->edges.size() - 1) % outline->edges.size()].curve;
  const Flat step = to - after.start;
  if (after.kind == Curve::Kind::Cubic) after.control1 += step;
  if (before.kind == Curve::Kind::Cubic) before.control2 += step;
  after.start = before.end = to;
  auto good = checked(*outline);
  if (!good) return good.error();
  *outline = std::move(*good);
  return moved;
}

Result<Piece> moveEdge(const Piece& piece, std::string_view edge, double by, bool whole) {
  Piece moved = piece;
  const auto [outline, k] = findIn(moved, edge);
  if (!outline) return noEdge(piece, edge);
  const Curve curve = outline->edges[k].curve;
  const std::string next = outline->edges[(k + 1) % outline->edges.size()].name;
  const Flat step = leftOf(normalized(curve.end - curve.start)) * by;
  const auto tenth = [](Flat p) { return Flat{std::round(p.u * 1e4) / 1e4, std::round(p.v * 1e4) / 1e4}; };
  if (whole)
    for (Flat& p : outline->edges[k].curve.between) p += step;
  const auto first = moveCorner(moved, edge, tenth(curve.start + step));
  if (!first) return first.error();
  return moveCorner(*first, next, tenth(curve.end + step));
}

}  // namespace karinui
