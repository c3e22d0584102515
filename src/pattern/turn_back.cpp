#include "karinui/pattern/turn_back.h"

#include <algorithm>
#include <cmath>

#include "pattern/divide_edges.h"
#include "pattern/words.h"

namespace karinui {

namespace {

struct StraightLine {
  Flat from, along;                                                     // unit
  double side(Flat place) const { return cross(along, place - from); }  // > 0: to the left
  double away(Flat place) const { return std::fabs(side(place)); }
};

// Where the outline crosses the line nearest to one of its ends; nothing: at a corner that is there.
std::optional<EdgePlace> placeOf(const Outline& outline, const StraightLine& line, Flat end) {
  constexpr int kSteps = 400;
  EdgePlace best{};
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    const Curve& curve = outline.edges[k].curve;
    for (int i = 0; i < kSteps; ++i) {
      double low = static_cast<double>(i) / kSteps, high = static_cast<double>(i + 1) / kSteps;
      const bool left = line.side(curve.at(low)) > 0;
      if (left == (line.side(curve.at(high)) > 0)) continue;
      for (int half = 0; half < 50; ++half) {
        const double middle = (low + high) / 2;
        (left == (line.side(curve.at(middle)) > 0) ? low : high) = middle;
      }
      if (const double off = distance(curve.at(low), end); off < least) least = off, best = {k, low};
    }
  }
  if (least == HUGE_VAL) return std::nullopt;
  const Curve& curve = outline.edges[best.edge].curve;
  const double along = curve.lengthTo(best.t);
  if (along < kLeastEdge || curve.length() - along < kLeastEdge) return std::nullopt;
  return best;
}

Curve withEnds(Curve curve, Flat start, Flat end) {
  // Turned and stretched so that it goes from one to the other.
  const Flat was = curve.end - curve.start, is = end - start;
  const double square = std::max(dot(was, was), 1e-18);
  const double re = dot(was, is) / square, im = cross(was, is) / square;
  const auto moved = [&, from = curve.start](Flat p) {
    const Flat d = p - from;
    return start + Flat{re * d.u - im * d.v, im * d.u + re * d.v};
  };
  if (curve.kind == Curve::Kind::Cubic) {
    curve.control1 = moved(curve.control1), curve.control2 = moved(curve.control2);
    for (Flat& p : curve.between) p = moved(p);
  }
  curve.start = start, curve.end = end;
  return curve;
}

// The curves from a corner on, one after the other, as far as they go from the line by `deep`.
std::optional<Curve> untilDeep(const std::vector<Curve>& way, const StraightLine& line, double deep) {
  constexpr int kSteps = 200;
  std::vector<Curve> taken;
  double before = 0;
  for (const Curve& curve : way) {
    double low = 0;
    for (int i = 1; i <= kSteps; ++i) {
      double t = static_cast<double>(i) / kSteps;
      const double now = line.away(curve.at(t));
      if (now < before - 1e-6) return std::nullopt;  // it comes back
      if (now < deep - 1e-9) {
        before = now, low = t;
        continue;
      }
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + t) / 2;
        (line.away(curve.at(middle)) < deep ? low : t) = middle;
      }
      taken.push_back(t > 1 - 1e-9 ? curve : curve.part(0, t));
      return Curve::joined(taken);
    }
    taken.push_back(curve);
  }
  return std::nullopt;
}

}  // namespace

Result<Flared> flaredBeyond(const Piece& piece, const std::string& name, const std::function<bool(Flat)>& beyond) {
  const auto line = std::find_if(piece.lines.begin(), piece.lines.end(), [&](const auto& l) { return l.name == name; });
  if (line == piece.lines.end()) return notFound(say("Piece {0} has no line {1}.", piece.name, name));
  const Flat from = line->curves.front().start, to = line->curves.back().end;
  const StraightLine straight{from, normalized(to - from)};
  constexpr double kStraight = 0.0005;  // metres
  for (const Curve& curve : line->curves)
    for (const Flat place : curve.flattened())
      if (straight.away(place) > kStraight)
        return refused(
            say("“{0}” is curved: what is beyond it cannot be the mirror image of what is before it.", name));
  Flared made{{piece, {}}, 0};
  std::vector<EdgePlace> places;
  for (const Flat end : {from, to})
    if (const auto place = placeOf(piece.outline, straight, end)) places.push_back(*place);
  divideEdges(made.edited.piece.outline, places, edgeNames(piece), piece.id, made.edited.edges);
  followMarks(made.edited.piece, made.edited.edges);

  // The edges beyond the line, from one of its ends to the other.
  auto& edges = made.edited.piece.outline.edges;
  const std::size_t n = edges.size();
  const auto isBeyond = [&](std::size_t k) { return beyond(edges[k % n].curve.atFraction(0.5)); };
  std::size_t first = 0;
  while (first < n && !(isBeyond(first) && !isBeyond(first + n - 1))) ++first;
  std::size_t count = 0;
  while (first < n && count < n && isBeyond(first + count)) ++count;
  std::size_t all = 0;
  for (std::size_t k = 0; k < n; ++k) all += isBeyond(k);
  if (count < 3 || count != all || n - count < 2)
    return refused(say("What is beyond “{0}” has not two sides and an end between them.", name));
  Curve& one = edges[first].curve;
  Curve& other = edges[(first + count - 1) % n].curve;

  // Both sides before the line, from its ends on.
  std::vector<Curve> backwards, onwards;
  for (std::size_t k = 1; k <= n - count; ++k) {
    backwards.push_back(edges[(first + n - k) % n].curve.reversed());
    onwards.push_back(edges[(first + count - 1 + k) % n].curve);
  }
  const auto before = untilDeep(backwards, straight, straight.away(one.end)),
             after = untilDeep(onwards, straight, straight.away(other.start));
  if (!before || !after) return refused(say("What is beyond “{0}” is deeper than what it comes to lie on.", name));
  const double was = std::fabs(dot(other.start - one.end, straight.along));
  one = before->mirrored(from, straight.along);
  other = after->mirrored(from, straight.along).reversed();
  one.start = edges[(first + n - 1) % n].curve.end, other.end = edges[(first + count) % n].curve.start;
  made.wider = std::fabs(dot(other.start - one.end, straight.along)) - was;

  // The end between them, as a whole turned and stretched.
  const Flat start = edges[(first + 1) % n].curve.start, end = edges[(first + count - 2) % n].curve.end;
  const Curve chord = Curve::cubic(start, start, end, end);
  const auto moved = [&](Flat p) {
    Curve carried = chord;
    carried.control1 = p;
    return withEnds(carried, one.end, other.start).control1;
  };
  Flat last = one.end;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    Curve& curve = edges[(first + k) % n].curve;
    const Flat next = k + 2 == count ? other.start : moved(curve.end);
    curve = withEnds(curve, last, next);
    last = next;
  }
  auto outline = checked(made.edited.piece.outline);
  if (!outline) return outline.error();
  made.edited.piece.outline = *std::move(outline);
  return made;
}

}  // namespace karinui
