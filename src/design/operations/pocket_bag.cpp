#include "design/operations/pocket_bag.h"

#include <cmath>

#include "design/operations/said.h"
#include "karinui/pattern/darts.h"

namespace karinui {

namespace {

// The outline as it is where its darts are sewn up: a bag hangs across them.
Ring withoutDarts(const Pattern& pattern, const Piece& piece) {
  std::set<std::size_t> legs;
  for (const PaperDart& dart : dartsOf(pattern))
    if (dart.piece == piece.id) legs.insert(dart.to), legs.insert(dart.back);
  Ring ring;
  for (std::size_t k = 0; k < piece.outline.edges.size(); ++k) {
    const Curve& curve = piece.outline.edges[k].curve;
    const std::vector<Flat> places = legs.contains(k) ? std::vector{curve.start, curve.end} : curve.flattened(1e-4);
    if (legs.contains(k) && legs.contains((k + 1) % piece.outline.edges.size()))
      ring.push_back(places.front());  // and not the point
    else if (!legs.contains(k))
      ring.insert(ring.end(), places.begin(), places.end() - 1);
  }
  return ring;
}

// From the edge's lower place round the bag up to its upper one. Where a dart or a seam ends the edge above before the
// bag is as wide as it should be, a `broad` bag has its width below that all the same.
std::vector<Curve> hangingLine(const Curve& side, bool down, const BagSize& size, std::optional<Flat> top, bool broad) {
  constexpr double kNarrower = 5e-3, kShoulder = 0.03;  // metres
  const Flat upper = down ? side.start : side.end, lower = down ? side.end : side.start;
  const Flat y = normalized(lower - upper), x = down ? leftOf(y) : -leftOf(y);
  const double end = distance(upper, lower), bottom = end - (size.to - size.low) + size.below;
  const double half = size.depth / 2, turn = std::min(half, (bottom - end / 3) / 2);
  const auto at = [&](double in, double deep) { return upper + x * in + y * deep; };
  const Flat lowest = at(half, bottom), farthest = at(size.depth, bottom - turn);
  const double hang = bottom - end, missing = top ? size.depth - dot(*top - upper, x) : 0;
  const Curve last =
      top && broad && missing > kNarrower ? Curve::cubic(farthest, at(size.depth, (bottom - turn) * 0.1),
                                                         *top + x * (0.8 * missing) + y * kShoulder, *top)
      : top ? Curve::cubic(farthest, at(size.depth, (bottom - turn) * 0.6), *top + y * (0.3 * bottom), *top)
            : Curve::cubic(farthest, at(size.depth, (bottom - turn) * 0.3), at(0.6 * size.depth, 0.1 * end), upper);
  return {Curve::cubic(lower, at(0.1 * size.depth, end + 0.55 * hang), at(half - 0.3 * size.depth, bottom), lowest),
          Curve::cubic(lowest, at(half + 0.28 * size.depth, bottom), at(size.depth, bottom - turn * 0.45), farthest),
          last};
}

bool bagFits(const Pattern& pattern, const Piece& piece, const std::vector<Curve>& line, bool half) {
  const Ring ring = withoutDarts(pattern, piece);
  const auto symmetry = half ? symmetryOf(piece.outline) : std::nullopt;
  const auto beside = [&](Flat place) { return cross(symmetry->axis, place - symmetry->through); };
  constexpr int kSteps = 16;
  constexpr double kRoom = 1e-3, kAtEnds = 0.02;  // metres from the edges; but for the ends, which lie on them
  for (std::size_t k = 0; k < line.size(); ++k)
    for (int n = k == 0 ? 1 : 0; n < kSteps; ++n) {
      const Flat place = line[k].at(n / static_cast<double>(kSteps));
      const bool amidst = std::min(distance(place, line.front().start), distance(place, line.back().end)) > kAtEnds;
      if (!contains(ring, place) || (amidst && distanceToRing(ring, place) < kRoom)) return false;
      if (symmetry && beside(place) * beside(line.front().start) <= 0) return false;
    }
  return true;
}

std::vector<Curve> hangingLine(const DownEdge& side, const BagSize& size, bool broad) {
  const EdgeSpan span = side.span(size.from, size.to);
  const auto top = size.top > 0 ? std::optional(edgeAbove(side).at(size.top)) : std::nullopt;
  return hangingLine(curvePart(side.edge.curve, span.from, span.to), side.down, size, top, broad);
}

// What may be said instead: how deep a bag has room.
Message noBagRoom(const Pattern& pattern, const DownEdge& side, const BagSize& size) {
  BagSize less = size;
  for (less.depth = std::floor(size.depth * 100 - 1e-6) / 100; less.depth >= 0.04; less.depth -= 0.01)
    if (bagFits(pattern, side.piece, hangingLine(side, less, false), size.half))
      return say("“{0}” has no room for bags that reach {1} cm in from {2}; {3} cm have.", side.piece.name,
                 centimetres(size.depth), side.edge.name, centimetres(less.depth));
  return say("“{0}” has no room for bags beside {1} that hang {2} cm below the opening.", side.piece.name,
             side.edge.name, centimetres(size.below));
}

}  // namespace

Curve curvePart(const Curve& curve, double from, double to) {
  const double whole = curve.length();
  return curve.part(curve.parameterAt(from * whole), curve.parameterAt(to * whole));
}

Outline bagOutline(std::vector<Edge> edges, bool down) {
  if (!down) {
    std::reverse(edges.begin(), edges.end());
    for (Edge& edge : edges) edge.curve = edge.curve.reversed();
  }
  for (std::size_t k = 0; k < edges.size(); ++k) edges[(k + 1) % edges.size()].curve.start = edges[k].curve.end;
  return {std::move(edges)};
}

Result<std::vector<Curve>> bagLine(const Pattern& pattern, const DownEdge& side, const BagSize& size) {
  for (const bool broad : {true, false})
    if (std::vector<Curve> line = hangingLine(side, size, broad); bagFits(pattern, side.piece, line, size.half))
      return line;
  return refused(noBagRoom(pattern, side, size));
}

Result<DividedPart> bagBeside(const Pattern& pattern, const DownEdge& side, const BagSize& size) {
  const auto line = bagLine(pattern, side, size);
  if (!line) return line.error();
  DividedPart bag;
  std::vector<Edge> edges;
  const auto add = [&](const EdgeSpan& span, const Curve& curve, const char* name) {
    const Curve part = curvePart(curve, span.from, span.to);
    edges.push_back({name, side.down ? part : part.reversed()});
    bag.edges.push_back({span, {{}, name, 0, 1}});
  };
  const EdgeAbove above = edgeAbove(side);
  if (size.top > 0) add(above.span(0, size.top), above.edge.curve, kBagTop);
  add(side.span(size.from, size.to), side.edge.curve, kBagSide);
  bag.inner = kBagInner;
  edges.push_back({bag.inner, Curve::joined(*line)});
  bag.outline = bagOutline(std::move(edges), side.down);
  if (!side.down) std::reverse(bag.edges.begin(), bag.edges.end());
  if (const auto sound = checked(bag.outline); !sound) return sound.error();
  return bag;
}

}  // namespace karinui
