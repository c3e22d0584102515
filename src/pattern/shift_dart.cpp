// A dart moved along the edge it opens at, as it is: what the edge gives up on its one side it gains on the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "divide_edges.h"
#include "karinui/base/number.h"
#include "karinui/pattern/edit.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kLeastBesideDart = 1e-3;                 // metres of the edge that are left beside it
constexpr double kOneLine = 30 * std::numbers::pi / 180;  // by which the edge may turn where the dart is closed
constexpr double kDrillAtTip = 2e-3;                      // metres: a drill hole there marks the point
constexpr double kSeamKept = 1e-8, kSeamTrue = 5e-4;      // metres

// The curve so that it starts and ends there.
Curve carriedEnds(Curve curve, Flat start, Flat end) {
  if (curve.kind == Curve::Kind::Cubic) curve.control1 += start - curve.start, curve.control2 += end - curve.end;
  curve.start = start, curve.end = end;
  return curve;
}

Curve shiftedBy(Curve curve, Flat by) {
  curve.start += by, curve.end += by, curve.control1 += by, curve.control2 += by;
  for (Flat& p : curve.between) p += by;
  return curve;
}

// Two curves in one, which stays a straight line where both are.
Curve oneAfterOther(const Curve& first, const Curve& second) {
  if (first.kind == Curve::Kind::Line && second.kind == Curve::Kind::Line) return Curve::line(first.start, second.end);
  const std::array both{first, second};
  return Curve::joined(both);
}

}  // namespace

Result<EditedPiece> shiftDart(const Piece& piece, std::string_view leg, double by) {
  const auto& edges = piece.outline.edges;
  const auto i = piece.outline.find(leg);
  if (!i) return noEdge(piece, leg);
  const std::size_t n = edges.size(), b = (*i + n - 1) % n, o = (*i + 1) % n, a = (*i + 2) % n;
  const Curve &in = edges[*i].curve, &out = edges[o].curve, &before = edges[b].curve, &behind = edges[a].curve;
  const Flat tip = in.end, from = in.start, until = out.end;
  const auto angleOf = [&](Flat p) { return std::atan2(p.v - tip.v, p.u - tip.u); };
  const double closing = std::remainder(angleOf(from) - angleOf(until), 2 * std::numbers::pi);
  // The edge is one line as the dart is closed, where it was trued, or as it lies open, where it was drawn so.
  const auto turn = [&](const Curve& next) {
    return std::fabs(angleFrom(endTangent(before, true), endTangent(next, false)));
  };
  const bool open = turn(behind) <= turn(behind.rotated(tip, closing));
  if (a == b || turn(open ? behind : behind.rotated(tip, closing)) > kOneLine)
    return refused(
        say("The dart {0} of “{1}” opens at a corner, not within an edge: there is nothing to move it along.", leg,
            piece.name));
  const auto across = [&](const Curve& curve, double way) {  // to the other side of the dart
    return open ? shiftedBy(curve, (from - until) * way) : curve.rotated(tip, closing * way);
  };
  const double one = before.length(), other = behind.length(), room = (by > 0 ? other : one) - kLeastBesideDart;
  if (std::fabs(by) > room)
    return refused(say("There are {0} mm of {1} on that side of the dart {2}; it cannot be moved {3} mm.",
                       inMm(by > 0 ? other : one), by > 0 ? edges[a].name : edges[b].name, leg, inMm(std::fabs(by))));
  // So much of it changes sides.
  Curve first = before, second = behind;
  Flat step;
  if (by > 0) {
    const double t = behind.parameterAt(by);
    const Curve taken = across(behind.part(0, t), 1);
    second = behind.part(t, 1);
    first = oneAfterOther(before, carriedEnds(taken, before.end, taken.end));
    step = ((taken.end - from) + (second.start - until)) * 0.5;
  } else {
    const double t = before.parameterAt(one + by);
    const Curve taken = across(before.part(t, 1), -1);
    first = before.part(0, t);
    second = oneAfterOther(carriedEnds(taken, taken.start, behind.start), behind);
    step = ((first.end - from) + (taken.start - until)) * 0.5;
  }
  // The dart goes as it is; square to its way it goes so far that the edge is as long as it was.
  const Flat square = leftOf(normalized(step));
  const auto lies = [&](double off) { return step + square * off; };
  const auto beside = [&](double off) {
    return std::pair(carriedEnds(first, before.start, from + lies(off)),
                     carriedEnds(second, until + lies(off), behind.end));
  };
  const auto longer = [&](double off) {
    const auto [left, right] = beside(off);
    return left.length() + right.length() - one - other;
  };
  double off = 0;
  if (std::fabs(longer(0)) > kSeamKept) {
    // The edge is longer the farther off the dart is, either way, from where it is shortest.
    double low = -std::fabs(by), high = std::fabs(by);
    for (int k = 0; k < 100; ++k) {
      const double third = (high - low) / 3;
      if (longer(low + third) < longer(high - third))
        high -= third;
      else
        low += third;
    }
    const double shortest = (low + high) / 2;
    off = shortest;
    if (longer(shortest) < 0) {  // as long, on the side that is nearer to its way
      double near = shortest, far = shortest <= 0 ? std::fabs(by) : -std::fabs(by);
      if (longer(far) < 0) far = -far;
      for (int k = 0; k < 100; ++k) (longer((near + far) / 2) < 0 ? near : far) = (near + far) / 2;
      off = (near + far) / 2;
    }
    if (std::fabs(longer(off)) > kSeamTrue)
      return refused(
          say("Moved {0} mm, the dart {1} of “{2}” would leave an edge {3} mm longer than it is. Move it less.",
              inMm(std::fabs(by)), leg, piece.name, inMm(longer(off))));
  }
  const Flat way = lies(off);
  EditedPiece shifted{piece, {}};
  Outline& outline = shifted.piece.outline;
  std::tie(outline.edges[b].curve, outline.edges[a].curve) = beside(off);
  for (const std::size_t side : {*i, o}) outline.edges[side].curve = shiftedBy(edges[side].curve, way);
  outline.edges[*i].curve.start = outline.edges[b].curve.end;
  outline.edges[o].curve.end = outline.edges[a].curve.start;
  const Ring wedge{from + way, until + way, tip + way};
  for (const Outline& hole : piece.holes)
    for (const Flat p : hole.flattened(1e-3))
      if (contains(wedge, p)) return refused(say("The dart would run into a hole of {0}.", piece.name));
  auto good = checked(outline);
  if (!good) return good.error();
  outline = *std::move(good);
  const std::string &ahead = edges[b].name, &after = edges[a].name;
  const double now = outline.edges[b].curve.length(), rest = outline.edges[a].curve.length();
  EdgeMap& map = shifted.edges;
  const PieceId id = piece.id;
  if (by > 0) {
    const double share = by / other, where = one / now;
    map[{id, ahead}] = {{0, 1, {id, ahead, 0, where}}};
    map[{id, after}] = {{0, share, {id, ahead, where, 1}}, {share, 1, {id, after, 0, 1}}};
  } else {
    const double share = 1 + by / one, where = -by / rest;
    map[{id, ahead}] = {{0, share, {id, ahead, 0, 1}}, {share, 1, {id, after, 0, where}}};
    map[{id, after}] = {{0, 1, {id, after, where, 1}}};
  }
  followMarks(shifted.piece, map);
  for (Mark& mark : shifted.piece.marks)
    if (mark.edge.empty() && distance(mark.place, tip) < kDrillAtTip) mark.place += way;
  return shifted;
}

}  // namespace karinui
