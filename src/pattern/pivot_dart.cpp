// A dart moved to another edge: the paper is slit there up to the dart's point, and one side of it turned about the
// point until the dart is closed.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/pattern/edit.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kLegs = 2e-3;    // metres by which the legs may differ
constexpr double kOnSlit = 1e-5;  // metres: a place this near to a slit lies on it

bool crossesInside(const Ring& ring, Flat from, Flat to) {
  constexpr int kPlaces = 64;
  for (int i = 1; i < kPlaces; ++i)
    if (!contains(ring, lerp(from, to, static_cast<double>(i) / kPlaces))) return true;
  return false;
}

// What lies in the part that turns, turned.
class Turned {
 public:
  Turned(Ring region, Flat about, double angle) : region_(std::move(region)), about_(about), angle_(angle) {}
  Flat operator()(Flat p) const { return Curve::line(p, p).rotated(about_, angle_).start; }
  Curve operator()(const Curve& curve) const { return curve.rotated(about_, angle_); }
  bool holds(Flat p) const { return contains(region_, p) || distanceToRing(region_, p) < kOnSlit; }
  bool holds(const std::vector<Curve>& curves) const {
    return std::all_of(curves.begin(), curves.end(),
                       [&](const Curve& c) { return holds(c.start) && holds(c.at(0.5)) && holds(c.end); });
  }
  void turn(std::vector<Curve>& curves) const {
    if (holds(curves))
      for (Curve& curve : curves) curve = (*this)(curve);
  }

 private:
  Ring region_;
  Flat about_;
  double angle_;
};

// The cloth keeps its place in space: nodes of the part that turned have new places on paper. What lay across the slit
// belongs to neither bank.
std::shared_ptr<const Form> turnedForm(const Form& form, const Turned& turned) {
  auto now = std::make_shared<Form>(form);
  std::vector<bool> turns(form.flat.size());
  for (std::size_t k = 0; k < form.flat.size(); ++k)
    if ((turns[k] = turned.holds(form.flat[k]))) now->flat[k] = turned(form.flat[k]);
  std::erase_if(now->faces,
                [&](const Triangle& f) { return turns[f[0]] != turns[f[1]] || turns[f[0]] != turns[f[2]]; });
  return now->faces.empty() ? nullptr : now;
}

}  // namespace

Result<EditedPiece> pivotDart(const Piece& piece, std::string_view leg, std::string_view edge, double fraction) {
  const auto& before = piece.outline.edges;
  const auto i = piece.outline.find(leg);
  if (!i || !piece.outline.find(edge)) return noEdge(piece, i ? edge : leg);
  const std::string back = before[(*i + 1) % before.size()].name;
  if (edge == leg || edge == back) return refused(say("A dart is moved to another edge than its own sides."));
  const Curve &in = before[*i].curve, &out = before[(*i + 1) % before.size()].curve;
  const Flat tip = in.end, from = in.start, until = out.end;
  if (std::fabs(distance(from, tip) - distance(until, tip)) > kLegs)
    return refused(
        say("The sides {0} and {1} of the dart of “{2}” are {3} and {4} mm long; make them alike, then move it.", leg,
            back, piece.name, inMm(distance(from, tip)), inMm(distance(until, tip))));
  auto split = splitEdge(piece, edge, fraction);
  if (!split) return split;
  Piece now = split->piece;
  const auto& edges = now.outline.edges;
  const std::size_t n = edges.size(), k = *now.outline.find(edge), d = *now.outline.find(leg);
  const Flat open = edges[k].curve.end;
  const Ring whole = piece.outline.flattened(1e-4);
  if (crossesInside(whole, open, tip))
    return refused(
        say("The paper of “{0}” cannot be cut straight from {1}@{2} to the point of the dart {3} at "
            "{4}, {5} cm: the way leads out of the piece. Choose another place (at=…) or another edge.",
            piece.name, edge, fixed(fraction, 2), leg, fixed(100 * tip.u, 1), fixed(100 * tip.v, 1)));
  // From the dart on to the slit, and from the slit on to the dart; the shorter turns.
  std::vector<Edge> ahead, behind;
  for (std::size_t e = (d + 2) % n; e != (k + 1) % n; e = (e + 1) % n) ahead.push_back(edges[e]);
  for (std::size_t e = (k + 1) % n; e != d; e = (e + 1) % n) behind.push_back(edges[e]);
  if (ahead.empty() || behind.empty())
    return refused(say("The dart {0} of “{1}” ends at {2}@{3}, where that edge is to be opened; choose another place.",
                       leg, piece.name, edge, fixed(fraction, 2)));
  const auto lengthOf = [](const std::vector<Edge>& part) {
    double all = 0;
    for (const Edge& e : part) all += e.curve.length();
    return all;
  };
  const bool first = lengthOf(ahead) < lengthOf(behind);
  std::vector<Edge>& turning = first ? ahead : behind;
  const auto angleOf = [&](Flat p) { return std::atan2(p.v - tip.v, p.u - tip.u); };
  const double angle = first ? angleOf(from) - angleOf(until) : angleOf(until) - angleOf(from);
  Ring region{tip};
  for (const Edge& e : turning)
    for (const Flat p : e.curve.flattened(1e-4))
      if (distance(p, region.back()) > 1e-9) region.push_back(p);
  const Turned turned(std::move(region), tip, angle);
  for (Edge& e : turning) e.curve = turned(e.curve);
  // The dart is closed exactly.
  (first ? ahead.front().curve.start : behind.back().curve.end) = first ? from : until;
  Outline outline;
  outline.edges = behind;
  outline.edges.insert(outline.edges.end(), ahead.begin(), ahead.end());
  outline.edges.push_back({std::string(leg), Curve::line(ahead.back().curve.end, tip)});
  outline.edges.push_back({back, Curve::line(tip, behind.front().curve.start)});
  auto good = checked(std::move(outline));
  if (!good)
    return Error{good.error().kind, say("“{0}” with its dart {1} moved to {2}@{3}: {4}", piece.name, leg, edge,
                                        fixed(fraction, 2), good.error().what)};
  now.outline = *std::move(good);
  for (Outline& hole : now.holes)
    if (std::all_of(hole.edges.begin(), hole.edges.end(), [&](const Edge& e) { return turned.holds(e.curve.start); }))
      for (Edge& e : hole.edges) e.curve = turned(e.curve);
  for (InternalLine& line : now.lines) turned.turn(line.curves);
  for (Mark& mark : now.marks)
    if (mark.edge.empty() && turned.holds(mark.place)) mark.place = turned(mark.place);
  if (piece.form) now.form = turnedForm(*piece.form, turned);
  split->piece = std::move(now);
  return split;
}

}  // namespace karinui
