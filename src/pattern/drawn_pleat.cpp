// A pleat that is drawn on the paper already. The paper is closed over it, as if it had been folded away; then it is
// pleated there like any other, so that edges, layers and lines are the same.
#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "karinui/pattern/pleats.h"
#include "outline_passages.h"
#include "wedge_pleat.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kParallel = 1e-3;      // metres by which lines may be off
constexpr double kClosedWithin = 2e-3;  // metres by which an edge may be off where it is closed

class Closing {
 public:
  Closing(const Piece& piece, const DrawnPleat& drawn, double low, double depth)
      : piece_(piece), across_(-leftOf(drawn.along)), low_(low), depth_(depth) {}

  Result<EditedPiece> closed(Flat nearLow, Flat nearHigh, Flat farLow, Flat farHigh, std::string& nearName) {
    const auto passage = [&](double at, Flat near) { return passageNear(piece_.outline, across_, at, near); };
    const auto a = passage(low_, nearLow), b = passage(low_ + 2 * depth_, nearHigh),
               c = passage(low_ + 2 * depth_, farHigh), d = passage(low_, farLow);
    if (!a || !b || !c || !d || a->edge == c->edge)
      return refused(say("The lines of a pleat run across “{0}”, from one edge to another.", piece_.name));
    made_.piece = piece_;
    made_.piece.outline.edges.clear();
    nearName = piece_.outline.edges[a->edge].name;
    // From a, over the far edge, round to b: what lies between a and b, and between c and d, is folded away.
    if (Done done = join(*d, *a, *b, *c); !done) return done.error();
    auto good = checked(std::move(made_.piece.outline));
    if (!good) return good.error();
    made_.piece.outline = *std::move(good);
    for (Outline& hole : made_.piece.holes) {
      if (within(hole.flattened(1e-4))) return refused(say("The pleats would run through a hole of {0}.", piece_.name));
      const bool beyond = across(hole.edges.front().curve.start) > low_;
      for (Edge& edge : hole.edges) edge.curve = moved(edge.curve, beyond);
    }
    std::erase_if(made_.piece.lines, [&](const InternalLine& line) { return line.curves.empty(); });
    for (InternalLine& line : made_.piece.lines)
      for (Curve& curve : line.curves) {
        if (within(curve.flattened(1e-4)))
          return refused(say("The pleats would run through the line “{0}” of {1}; pleat first, and draw it then.",
                             line.name, piece_.name));
        curve = moved(curve, across(curve.at(0.5)) > low_);
      }
    std::erase_if(made_.piece.marks, [&](const Mark& mark) {
      return mark.edge.empty() && across(mark.place) > low_ && across(mark.place) < low_ + 2 * depth_;
    });
    for (Mark& mark : made_.piece.marks)
      if (mark.edge.empty() && across(mark.place) > low_) mark.place = mark.place - across_ * (2 * depth_);
    followMarks(made_.piece, made_.edges);
    return std::move(made_);
  }

 private:
  double across(Flat p) const { return dot(p, across_); }
  Curve moved(Curve curve, bool beyond) const {
    if (!beyond) return curve;
    const Flat by = across_ * (-2 * depth_);
    curve.start += by, curve.end += by;
    if (curve.kind == Curve::Kind::Cubic) curve.control1 += by, curve.control2 += by;
    for (Flat& p : curve.between) p += by;
    return curve;
  }
  bool within(const std::vector<Flat>& line) const {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Flat p : line) low = std::min(low, across(p)), high = std::max(high, across(p));
    return high > low_ + kParallel && low < low_ + 2 * depth_ - kParallel;
  }

  // The outline from `from` to `to` on one side of the pleat, then the other side, moved up against it.
  Done join(const Passage& farLow, const Passage& nearLow, const Passage& nearHigh, const Passage& farHigh) {
    struct Part : EdgeStretch {
      bool beyond = false;
    };
    const auto& edges = piece_.outline.edges;
    std::vector<Part> parts;
    const auto walk = [&](const Passage& from, const Passage& to, bool beyond) {
      for (const EdgeStretch& stretch : stretchesBetween(piece_.outline, from, to)) parts.push_back({stretch, beyond});
    };
    walk(farLow, nearLow, false);
    const std::size_t first = parts.size();
    walk(nearHigh, farHigh, true);
    if (first == 0 || first == parts.size())
      return refused(say("The lines of a pleat run across “{0}”, from one edge to another.", piece_.name));
    for (const auto& [here, there] : {std::pair(nearLow, nearHigh), std::pair(farLow, farHigh)}) {
      const double off = distance(here.place, there.place - across_ * (2 * depth_));
      if (off > kClosedWithin)
        return refused(
            say("Folded, edge {0} has a step of {1} mm: the fold and the line where it comes to lie end there "
                "at unlike heights.",
                edges[here.edge].name, inMm(off)));
    }
    std::vector<Curve> curves;
    std::vector<std::vector<Part>> made;  // what each edge is made of
    for (const Part& part : parts) {
      const Curve curve =
          moved(part.t0 <= 0 && part.t1 >= 1 ? edges[part.edge].curve : edges[part.edge].curve.part(part.t0, part.t1),
                part.beyond);
      const bool goesOn = !made.empty() && made.back().back().edge == part.edge && made.back().back().t1 < part.t0;
      if (goesOn)
        curves.back() = joined(curves.back(), curve), made.back().push_back(part);
      else
        curves.push_back(curve), made.push_back({part});
    }
    // The far edge may have been begun with its second part.
    if (made.size() > 2 && made.front().front().edge == made.back().back().edge &&
        made.front().front().t0 > made.back().back().t1) {
      curves.front() = joined(curves.back(), curves.front());
      made.front().insert(made.front().begin(), made.back().begin(), made.back().end());
      curves.pop_back(), made.pop_back();
    }
    for (const Edge& edge : edges) made_.edges[{piece_.id, edge.name}] = {};
    for (std::size_t k = 0; k < made.size(); ++k) {
      const Edge& old = edges[made[k].front().edge];
      made_.piece.outline.edges.push_back({old.name, curves[k]});
      const double whole = old.curve.length();
      double now = 0, all = 0;
      for (const Part& part : made[k]) all += old.curve.lengthTo(part.t1) - old.curve.lengthTo(part.t0);
      for (const Part& part : made[k]) {
        const double from = old.curve.lengthTo(part.t0), to = old.curve.lengthTo(part.t1);
        made_.edges[{piece_.id, old.name}].push_back(
            {from / whole, to / whole, {piece_.id, old.name, now / all, std::min(1.0, (now + to - from) / all)}});
        now += to - from;
      }
    }
    auto& all = made_.piece.outline.edges;
    for (std::size_t k = 0; k < all.size(); ++k) all[(k + 1) % all.size()].curve.start = all[k].curve.end;
    return {};
  }

  static Curve joined(Curve first, Curve second) {
    second.start = first.end;
    const bool straight =
        first.kind == Curve::Kind::Line && second.kind == Curve::Kind::Line &&
        std::abs(cross(normalized(first.end - first.start), normalized(second.end - second.start))) < 1e-6;
    if (straight) return Curve::line(first.start, second.end);
    const Curve both[] = {first, second};
    return Curve::joined(both);
  }

  const Piece& piece_;
  Flat across_;
  double low_ = 0, depth_ = 0;
  EditedPiece made_;
};

}  // namespace

Result<PleatedPiece> foldDrawn(const Piece& piece, const DrawnPleat& drawn) {
  const Flat across = -leftOf(drawn.along);
  // The near and the far end of each line, walked along the pleat.
  std::array<PleatLine, 3> ends;
  std::array<double, 3> at{};
  bool alongside = true;
  const std::string* names[] = {&drawn.fold, &drawn.inner, &drawn.place};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto line =
        std::find_if(piece.lines.begin(), piece.lines.end(), [&](const auto& l) { return l.name == *names[k]; });
    if (line == piece.lines.end() || line->curves.empty())
      return notFound(say("Piece {0} has no line “{1}”.", piece.name, *names[k]));
    Flat from = line->curves.front().start, to = line->curves.back().end;
    if (dot(to - from, drawn.along) < 0) std::swap(from, to);
    ends[k] = {from, to};
    at[k] = 0.5 * (dot(from, across) + dot(to, across));
    alongside = alongside && std::abs(dot(to - from, across)) <= 2 * kParallel;
  }
  Piece bare = piece;
  std::erase_if(bare.lines, [&](const InternalLine& line) {
    return line.name == drawn.fold || line.name == drawn.inner || line.name == drawn.place;
  });
  if (!alongside) return foldWedge(bare, drawn, ends);
  const double depth = std::abs(at[2] - at[0]) / 2;
  if (std::abs(at[1] - 0.5 * (at[0] + at[2])) > kParallel)
    return refused(
        say("The inner fold lies halfway between the fold and the line where it comes to lie; they are {0} mm and {1} "
            "mm from it.",
            inMm(std::abs(at[1] - at[0])), inMm(std::abs(at[2] - at[1]))));
  const bool toStart = at[0] > at[2];
  const auto &low = toStart ? ends[2] : ends[0], &high = toStart ? ends[0] : ends[2];
  std::string near;
  auto closed =
      Closing(bare, drawn, std::min(at[0], at[2]), depth).closed(low.near, high.near, low.far, high.far, near);
  if (!closed) return closed.error();
  PleatPlan plan;
  plan.edge = near, plan.depth = depth, plan.along = drawn.along, plan.name = drawn.name;
  plan.toStart = {toStart}, plan.sewnBeyond = drawn.sewnBeyond;
  // The edge that lies over what is folded in: beside the fold.
  const double fold = std::min(at[0], at[2]);
  for (const Edge& edge : closed->piece.outline.edges) {
    const double from = dot(edge.curve.start, across), to = dot(edge.curve.end, across);
    const double over = toStart ? fold + depth / 2 : fold - depth / 2;
    const auto height = [&](const Curve& curve) { return dot(curve.at(0.5), drawn.along); };
    const bool lower = dot(low.near, drawn.along) + dot(low.far, drawn.along) > 2 * height(edge.curve);
    if (from <= over && to >= over && lower) plan.edge = edge.name;
  }
  const Edge* edge = findEdge(closed->piece, plan.edge);
  const double from = dot(edge->curve.start, across), to = dot(edge->curve.end, across);
  if (fold <= from + 1e-7)
    plan.at = {0};
  else if (fold >= to - 1e-7)
    plan.at = {1};
  else {
    double a = 0, b = 1;
    for (int round = 0; round < 60; ++round)
      (dot(edge->curve.at(0.5 * (a + b)), across) < fold ? a : b) = 0.5 * (a + b);
    plan.at = {edge->curve.lengthTo(a) / edge->curve.length()};
  }
  auto made = addPleats(closed->piece, plan);
  if (!made) return made;
  made->edited.edges = composed(closed->edges, made->edited.edges);
  made->drawn = true;
  return made;
}

}  // namespace karinui
