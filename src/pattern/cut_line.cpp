#include "karinui/pattern/cut_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/winding.h"

namespace karinui {

namespace {

constexpr double kSamePoint = 1e-9;  // metres: points nearer than this are one
constexpr double kRunsOn = 0.0872;   // sine of 5 degrees: edges that turn less run on
constexpr double kKink = 0.94;       // cosine of 20 degrees: a curve that turns more has a corner
constexpr double kLeastHole = 1e-6;  // square metres
constexpr double kReach = 20;        // widths from an inward corner in which parallels meet
constexpr double kCurl = 0.985;      // cosine of 10 degrees: what turns more right at its end does not go that way

Flat outOf(Flat way) { return -leftOf(way); }

std::optional<Flat> meeting(Flat p, Flat way, Flat q, Flat other) {
  const double turned = cross(way, other);
  if (std::abs(turned) < 1e-9) return std::nullopt;
  return p + way * (cross(q - p, other) / turned);
}

std::vector<Flat> step(Flat a, Flat b) { return distance(a, b) < kSamePoint ? std::vector{a} : std::vector{a, b}; }

std::vector<Flat> mitre(const CutCorner& c, Flat a, Flat b) {
  const Flat tip = *meeting(a, c.before, b, c.after);
  const double wider = std::max(c.widthBefore, c.widthAfter);
  // Beside a much wider allowance the narrower one's line would cut a long way into it.
  if (dot(tip - a, c.before) < -wider || dot(tip - b, c.after) > wider) return step(a, b);
  const double far = distance(tip, c.place);
  if (far <= kLongestMitre * wider + kSamePoint) return {tip};
  const Flat way = (tip - c.place) * (1 / far), foot = c.place + way * wider;
  return {*meeting(foot, leftOf(way), a, c.before), *meeting(foot, leftOf(way), b, c.after)};
}

// Nothing where the kind leads nowhere.
std::vector<Flat> byKind(const CutCorner& c, Flat a, Flat b) {
  const double sine = cross(c.before, c.after);
  const Flat onBefore = c.place + c.before * (c.widthAfter / sine);  // the cut line after, on the seam line before
  const Flat onAfter = c.place - c.after * (c.widthBefore / sine);
  const auto folded = [](Flat way, Flat axis) { return axis * (2 * dot(way, axis)) - way; };
  switch (c.kind) {
    case CornerKind::Points:
      return {onAfter, onBefore};
    case CornerKind::MirrorBefore:
      if (const auto end = meeting(onBefore, folded(c.after, c.before), a, c.before)) return {*end, onBefore};
      return {};
    case CornerKind::MirrorAfter:
      if (const auto end = meeting(onAfter, folded(c.before, c.after), b, c.after)) return {onAfter, *end};
      return {};
    case CornerKind::SquareBefore:
      return {onBefore + outOf(c.before) * c.widthBefore, onBefore};
    case CornerKind::SquareAfter:
      return {onAfter, onAfter + outOf(c.after) * c.widthAfter};
    default:
      return {};
  }
}

// An edge or a part of a curve with its parallel; the cloth is on the left.
struct Side {
  Flat start, end, wayIn, wayOut;  // unit ways at its ends
  double width = 0;
  std::vector<Flat> points;  // of the parallel
};

// The way an edge goes at its end over the width of its allowance, where it curls right at the end. What is turned back
// along it would else be turned by twice the curl.
std::optional<Flat> wayBeforeCurl(const Side& side, const Curve& curve, bool atEnd) {
  const double own = curve.length();
  if (side.width <= 0 || own < 4 * side.width) return std::nullopt;
  const Flat near = curve.atFraction(atEnd ? 1 - side.width / own : side.width / own);
  const Flat way = normalized(atEnd ? side.end - near : near - side.start);
  return dot(way, atEnd ? side.wayOut : side.wayIn) < kCurl ? std::optional(way) : std::nullopt;
}

Side sideOf(const Curve& curve, double width, double miss) {
  Side side{curve.start, curve.end, endTangent(curve, false), endTangent(curve, true), width, {}};
  const std::vector<Flat> line = curve.flattened(miss);
  if (width <= 0) return side.points = line, side;
  side.points.push_back(side.start + outOf(side.wayIn) * width);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Flat in = normalized(line[i] - line[i - 1]), out = normalized(line[i + 1] - line[i]);
    if (dot(in, out) > kKink) {
      const Flat way = normalized(in + out);
      side.points.push_back(line[i] + outOf(way) * (width / dot(way, in)));
    } else if (cross(in, out) > 0) {
      for (const Flat p : cornerPoints({line[i], in, out, width, width, CornerKind::Mitre})) side.points.push_back(p);
    } else {
      side.points.push_back(line[i] + outOf(in) * width), side.points.push_back(line[i] + outOf(out) * width);
    }
  }
  side.points.push_back(side.end + outOf(side.wayOut) * width);
  return side;
}

std::optional<Flat> segmentsMeet(Flat a, Flat b, Flat c, Flat d) {
  const double turned = cross(b - a, d - c);
  if (std::abs(turned) < 1e-18) return std::nullopt;
  const double s = cross(c - a, d - c) / turned, t = cross(c - a, b - a) / turned;
  if (s < 0 || s > 1 || t < 0 || t > 1) return std::nullopt;
  return a + (b - a) * s;
}

// Two parallels that cross beside an inward corner are cut off there.
void cutOff(Side& before, Side& after) {
  const double reach = kReach * std::max({before.width, after.width, 1e-3});
  std::vector<Flat>&a = before.points, &b = after.points;
  for (std::size_t i = a.size() - 1; i-- > 0 && distance(a[i + 1], before.end) < reach;)
    for (std::size_t k = 0; k + 1 < b.size() && distance(b[k], after.start) < reach; ++k)
      if (const auto at = segmentsMeet(a[i], a[i + 1], b[k], b[k + 1])) {
        a.erase(a.begin() + static_cast<std::ptrdiff_t>(i) + 1, a.end());
        b.erase(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        a.push_back(*at), b.insert(b.begin(), *at);
        return;
      }
}

// What of a parallel lies beyond the point at which the corner takes over goes.
void endAt(Side& side, Flat point) {
  const auto beyond = [&](Flat p) { return dot(p - point, side.wayOut) > -kSamePoint; };
  while (side.points.size() > 1 && beyond(side.points.back())) side.points.pop_back();
}
void startAt(Side& side, Flat point) {
  const auto ahead = [&](Flat p) { return dot(p - point, side.wayIn) < kSamePoint; };
  std::size_t gone = 0;
  while (gone + 1 < side.points.size() && ahead(side.points[gone])) ++gone;
  side.points.erase(side.points.begin(), side.points.begin() + static_cast<std::ptrdiff_t>(gone));
}

// Without points that are there already or lie on the straight line between their neighbours.
Ring cleaned(const Ring& ring) {
  Ring apart;
  for (const Flat p : ring)
    if (apart.empty() || distance(apart.back(), p) > kSamePoint) apart.push_back(p);
  while (apart.size() > 1 && distance(apart.back(), apart.front()) <= kSamePoint) apart.pop_back();
  Ring out;
  const std::size_t n = apart.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Flat a = apart[(i + n - 1) % n], p = apart[i], b = apart[(i + 1) % n];
    const bool on = std::abs(cross(p - a, b - p)) <= kSamePoint * distance(a, b) && dot(p - a, b - p) > 0;
    if (!on) out.push_back(p);
  }
  return out;
}

// Round an outline, or round a hole the other way. Empty: nothing is left of the hole.
Ring ringOf(const Piece& of, const Outline& outline, const AllowancePlan& plan, double miss, bool hole) {
  const PieceId piece = of.id;
  std::vector<Side> sides;
  std::vector<const std::string*> names;  // null: across the mouth of a dart
  std::vector<Curve> curves;
  const std::size_t count = outline.edges.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Edge& edge = outline.edges[k];
    const auto widthOf = [&](std::size_t at) { return plan.width(piece, outline.edges[at % count].name); };
    if (!hole && plan.foldedDart(piece, (k + count - 1) % count)) continue;  // its second leg
    if (const PaperDart* dart = hole ? nullptr : plan.foldedDart(piece, k)) {
      const Flat peak = capOf(of, *dart);
      sides.push_back(sideOf(Curve::line(dart->from, peak), widthOf(k + count - 1), miss));
      sides.push_back(sideOf(Curve::line(peak, dart->until), widthOf(k + 2), miss));
      names.insert(names.end(), 2, nullptr), curves.resize(sides.size());
      continue;
    }
    curves.push_back(hole ? edge.curve.reversed() : edge.curve);
    sides.push_back(sideOf(curves.back(), widthOf(k), miss));
    names.push_back(&edge.name);
  }
  if (hole)
    std::reverse(sides.begin(), sides.end()), std::reverse(names.begin(), names.end()),
        std::reverse(curves.begin(), curves.end());
  const std::size_t n = sides.size();
  std::vector<std::vector<Flat>> corners(n);  // after each side
  for (std::size_t k = 0; k < n; ++k) {
    Side &before = sides[k], &after = sides[(k + 1) % n];
    const std::string *own = names[k], *next = names[(k + 1) % n];
    const CornerKind kind = !own || !next ? CornerKind::Mitre
                            : hole        ? mirrored(plan.corner(piece, *next, *own))
                                          : plan.corner(piece, *own, *next);
    const double sine = cross(before.wayOut, after.wayIn);
    const bool back = dot(before.wayOut, after.wayIn) < 0 && std::abs(sine) < kRunsOn;  // the point of a slit
    if (sine < 0 || back) {
      cutOff(before, after);  // else what they go round is found below
      continue;
    }
    if (kind == CornerKind::MirrorBefore)
      if (const auto way = wayBeforeCurl(before, curves[k], true))
        before.wayOut = *way, before.points.back() = before.end + outOf(*way) * before.width;
    if (kind == CornerKind::MirrorAfter)
      if (const auto way = wayBeforeCurl(after, curves[(k + 1) % n], false))
        after.wayIn = *way, after.points.front() = after.start + outOf(*way) * after.width;
    corners[k] = cornerPoints({before.end, before.wayOut, after.wayIn, before.width, after.width, kind});
    endAt(before, corners[k].front()), startAt(after, corners[k].back());
  }
  Ring ring;
  for (std::size_t k = 0; k < n; ++k) {
    ring.insert(ring.end(), sides[k].points.begin(), sides[k].points.end());
    ring.insert(ring.end(), corners[k].begin(), corners[k].end());
  }
  ring = cleaned(ring);
  const double area = ring.size() < 3 ? 0 : signedArea(ring);
  if ((hole ? area < 0 : area > 0) && !crossing(ring)) {
    if (hole) std::reverse(ring.begin(), ring.end());
  } else {
    ring = outlineOfTurns(ring, hole);
  }
  if (!hole) return ring;
  // Parallels that passed each other in the middle go round nothing, in the right direction.
  double narrowest = kWidestAllowance;
  for (const Side& side : sides) narrowest = std::min(narrowest, side.width);
  const Ring seam = outline.flattened(miss);
  const bool passed =
      std::any_of(ring.begin(), ring.end(), [&](Flat p) { return distanceToRing(seam, p) < narrowest - 10 * miss; });
  return passed || ring.size() < 3 || signedArea(ring) < kLeastHole ? Ring() : ring;
}

}  // namespace

std::vector<Flat> cornerPoints(const CutCorner& c) {
  const Flat a = c.place + outOf(c.before) * c.widthBefore, b = c.place + outOf(c.after) * c.widthAfter;
  const double sine = cross(c.before, c.after);
  if (std::abs(sine) < kRunsOn) return step(a, b);
  if (sine < 0) return {*meeting(a, c.before, b, c.after)};
  std::vector<Flat> points = byKind(c, a, b);
  const double longest = kLongestMitre * std::max(c.widthBefore, c.widthAfter) + kSamePoint;
  const bool near = std::all_of(points.begin(), points.end(), [&](Flat p) { return distance(p, c.place) <= longest; });
  return !points.empty() && near ? points : mitre(c, a, b);
}

std::optional<CutLines> cutLines(const Piece& piece, const AllowancePlan& plan, double miss) {
  const auto any = [&](const Outline& outline) {
    return std::any_of(outline.edges.begin(), outline.edges.end(),
                       [&](const Edge& edge) { return plan.width(piece.id, edge.name) > 0; });
  };
  if (!any(piece.outline) && std::none_of(piece.holes.begin(), piece.holes.end(), any)) return std::nullopt;
  CutLines lines;
  lines.outer = any(piece.outline) ? ringOf(piece, piece.outline, plan, miss, false) : piece.outline.flattened(miss);
  for (std::size_t k = 0; k < piece.holes.size(); ++k) {
    const Outline& hole = piece.holes[k];
    if (plan.foldedHoles(piece.id).contains(k)) continue;
    Ring ring = any(hole) ? ringOf(piece, hole, plan, miss, true) : hole.flattened(miss);
    if (ring.size() >= 3) lines.holes.push_back(std::move(ring));
  }
  return lines;
}

}  // namespace karinui
