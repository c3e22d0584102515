// A dart with two points: a hole in the shape of a kite, whose sides are to be sewn to each other.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/pattern/edit.h"
#include "meetings.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kFromEdge = 0.005;  // metres of cloth beside a point at least

}  // namespace

Result<DoubleDartedPiece> addDoubleDart(const Piece& piece, Flat from, Flat to, double width, double at,
                                        const std::string& name, const std::set<std::string>& sewnLines) {
  const double tall = distance(from, to);
  if (!(tall >= width && width >= kLeastEdge))
    return refused(
        say("A dart with two points is at least 1 mm wide, and no wider than it is long; this one would be "
            "{0} mm wide and {1} mm long.",
            inMm(width), inMm(tall)));
  if (!(at >= 0.05 && at <= 0.95))
    return refused(say("A dart with two points is widest between 0.05 and 0.95 of the way from one to the other."));
  const Flat along = (to - from) * (1 / tall), middle = lerp(from, to, at), half = leftOf(along) * (width / 2);
  const Flat corners[] = {from, middle - half, to, middle + half};
  auto taken = edgeNames(piece);
  DoubleDartedPiece made{piece, {}};
  Outline kite;
  for (std::size_t k = 0; k < 4; ++k) {
    made.edges[k] = freeName(name, taken);
    kite.edges.push_back({made.edges[k], Curve::line(corners[k], corners[(k + 1) % 4])});
  }
  std::vector<Flat> ring(std::begin(corners), std::end(corners));
  ring.push_back(from);
  const auto runsInto = [&](const std::vector<Curve>& curves) {
    Outline line;
    for (const Curve& curve : curves) line.edges.push_back({"", curve});
    std::vector<Meeting> met;
    meetings(ring, line, met);
    return !met.empty() || contains(Ring(ring.begin(), ring.end() - 1), curves.front().start);
  };
  const Ring border = piece.outline.flattened(1e-4);
  for (const Flat p : corners)
    if (!contains(border, p) || distanceToRing(border, p) < kFromEdge)
      return refused(say("A dart with two points lies within {0}, 5 mm from its edges at least; at {1} mm it does not.",
                         piece.name, inMm(p)));
  const auto curvesOf = [](const Outline& outline) {
    std::vector<Curve> curves;
    for (const Edge& edge : outline.edges) curves.push_back(edge.curve);
    return curves;
  };
  if (runsInto(curvesOf(piece.outline)))
    return refused(say("A dart with two points lies within {0}; this one runs into an edge.", piece.name));
  for (const Outline& hole : piece.holes)
    if (runsInto(curvesOf(hole)) || contains(hole.flattened(1e-4), from))
      return refused(say("The dart would run into a hole of {0}.", piece.name));
  for (const InternalLine& line : piece.lines)
    if (sewnLines.contains(line.name) && !line.curves.empty() && runsInto(line.curves))
      return refused(say("The dart would run into the line “{0}” of {1}, along which something is sewn or folded.",
                         line.name, piece.name));
  auto good = checked(std::move(kite));
  if (!good) return good.error();
  made.piece.holes.push_back(*std::move(good));
  return made;
}

}  // namespace karinui
