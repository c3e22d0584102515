// The paper is divided along the slash into the part ahead of it and the part behind, one or both of which are moved
// rigidly; edges and lines that were divided are joined again over the opening.
#include "karinui/pattern/spread.h"

#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "meetings.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kAtCorner = 1e-3;  // metres: a place this near to a corner is the corner
constexpr double kWay = 1e-5;       // metres: beside the ends of the slash the outline is not looked for
constexpr double kHair = 1e-7;      // of a curve's length: what becomes the opening, so that a seam holds it
constexpr double kNoPart = 1e-9;    // metres: shorter parts of a curve are none
constexpr double kRounded = 0.03;   // metres: a corner is rounded at most so far to either side
constexpr double kBand = 2;         // times the opening: how far beside the slash the form is stretched

struct Motion {  // about `from`, which comes to `to`
  Flat from, to;
  double turn = 0;
  Flat operator()(Flat p) const { return (*this)(Curve::line(p, p)).start; }
  Curve operator()(const Curve& curve) const {
    Curve moved = turn == 0 ? curve : curve.rotated(from, turn);
    const Flat by = to - from;
    moved.start += by, moved.end += by;
    if (curve.kind == Curve::Kind::Cubic) moved.control1 += by, moved.control2 += by;
    for (Flat& p : moved.between) p += by;
    return moved;
  }
};

// How the two parts move when the slash from a to b opens by `by` and `toBy`: the opening is a trapezoid with the two
// banks as its equal sides.
struct Opening {
  Motion ahead, behind;
  Opening() = default;
  Opening(Flat a, Flat b, double by, double toBy, Slash::Stays stays) {
    const double tilt = std::asin((by - toBy) / (2 * distance(a, b)));
    const Flat along = normalized(b - a), right = -leftOf(along);
    const Flat wide = right * std::cos(tilt) + along * std::sin(tilt);  // from the bank behind to the one ahead
    ahead = behind = {a, a, 0};
    if (stays == Slash::Stays::Behind) {
      ahead = {a, a + wide * by, 2 * tilt};
    } else if (stays == Slash::Stays::Ahead) {  // the same, turned back
      behind = {a, a - turned(wide, -2 * tilt) * by, -2 * tilt};
    } else {
      ahead = {a, a + right * (by / 2), tilt};
      behind = {a, a - right * (by / 2), -tilt};
    }
  }
};

// The two parts of the paper, and where each goes.
struct Parts {
  Ring ahead, behind;
  Opening opening;
  bool isAhead(Flat p) const {
    const auto away = [&](const Ring& ring) { return contains(ring, p) ? 0 : distanceToRing(ring, p); };
    return away(ahead) < away(behind);
  }
  const Motion& motion(bool forAhead) const { return forAhead ? opening.ahead : opening.behind; }
  Flat operator()(Flat p) const { return motion(isAhead(p))(p); }
};

// The parts of a curve led over openings, as one curve, and which share of the old one's length is which of the new.
struct Led {
  Curve curve;
  std::vector<std::array<double, 2>> shares;  // ascending, from {0, 0} to {1, 1}
};

bool straight(const std::vector<Curve>& curves) {
  const Flat along = normalized(curves.back().end - curves.front().start);
  return std::all_of(curves.begin(), curves.end(), [&](const Curve& c) {
    return c.kind == Curve::Kind::Line && dot(c.end - c.start, along) > 0 &&
           std::abs(cross(c.start - curves.front().start, along)) < kNoPart &&
           std::abs(cross(c.end - curves.front().start, along)) < kNoPart;
  });
}

Curve cutOff(const Curve& curve, double start, double end) {
  const double whole = curve.length();
  if (start == 0 && end == 0) return curve;
  return curve.part(start == 0 ? 0 : curve.parameterAt(start), end == 0 ? 1 : curve.parameterAt(whole - end));
}

// Parts with the lines between them that the openings are, joined. `round`: how far to either side of a corner the
// curve is led round it, at most; `through`: it is led through the corner.
Led led(const std::vector<Curve>& parts, const std::vector<double>& from, double round, bool through = false) {
  std::vector<Curve> all;
  std::vector<bool> opening;
  for (const Curve& part : parts) {
    if (!all.empty() && distance(all.back().end, part.start) > kNoPart)
      all.push_back(Curve::line(all.back().end, part.start)), opening.push_back(true);
    all.push_back(part), opening.push_back(false);
    if (all.size() > 1) all.back().start = all[all.size() - 2].end;
  }
  const std::size_t n = all.size();
  std::vector<double> before(n, 0), after(n, 0);  // what is cut off each at its start and end
  const bool line = straight(all);
  for (std::size_t k = 0; !line && round > 0 && k + 1 < n; ++k) {
    const Flat in = normalized(all[k].tangent(1)), out = normalized(all[k + 1].tangent(0));
    if (std::abs(cross(in, out)) < 1e-9) continue;
    const auto room = [&](std::size_t i) { return all[i].length() / (opening[i] ? 2 : 3); };
    after[k] = std::min(round, room(k)), before[k + 1] = std::min(round, room(k + 1));
  }
  std::vector<Curve> joined;
  std::vector<double> starts(n), ends(n);  // of each, metres along the new curve
  double along = 0;
  const auto add = [&](Curve curve) {
    if (!joined.empty()) curve.start = joined.back().end;
    if (distance(curve.start, curve.end) < kNoPart) return;
    along += curve.length(), joined.push_back(std::move(curve));
  };
  for (std::size_t k = 0; k < n; ++k) {
    starts[k] = along;
    if (all[k].length() - before[k] - after[k] > kNoPart) add(cutOff(all[k], before[k], after[k]));
    ends[k] = along;
    if (k + 1 == n || after[k] == 0) continue;
    const Curve &in = all[k], &out = all[k + 1];
    const double ti = in.parameterAt(in.length() - after[k]), to = out.parameterAt(before[k + 1]);
    if (through) {
      const Flat way = normalized(normalized(in.tangent(1)) + normalized(out.tangent(0)));
      add(Curve::cubic(in.at(ti), in.at(ti) + normalized(in.tangent(ti)) * (after[k] / 3),
                       in.end - way * (after[k] / 3), in.end));
      add(Curve::cubic(in.end, in.end + way * (before[k + 1] / 3),
                       out.at(to) - normalized(out.tangent(to)) * (before[k + 1] / 3), out.at(to)));
      continue;
    }
    const double handle = (after[k] + before[k + 1]) / 3;
    add(Curve::cubic(in.at(ti), in.at(ti) + normalized(in.tangent(ti)) * handle,
                     out.at(to) - normalized(out.tangent(to)) * handle, out.at(to)));
  }
  Led made{line ? Curve::line(all.front().start, all.back().end) : Curve::joined(joined), {{0, 0}}};
  const double whole = along, old = [&] {
    double sum = 0;
    for (const Curve& part : parts) sum += part.length();
    return sum;
  }();
  std::size_t part = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (opening[k]) continue;
    const double hair = kHair * old, begins = from[part] * old, ends_ = begins + all[k].length();
    if (part > 0) made.shares.push_back({(begins + std::max(before[k], hair)) / old, starts[k] / whole});
    if (part + 1 < parts.size()) made.shares.push_back({(ends_ - std::max(after[k], hair)) / old, ends[k] / whole});
    ++part;
  }
  made.shares.push_back({1, 1});
  return made;
}

// Parts that meet end to end where paper was folded out, as one curve that is led round the places where they meet.
// `olds`: which share of the old curve's length each part was; between them it is gone.
Led together(std::vector<Curve> parts, const std::vector<std::array<double, 2>>& olds, double round) {
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
    parts[k].end = parts[k + 1].start = lerp(parts[k].end, parts[k + 1].start, 0.5);
  std::vector<double> ends;  // of each but the last, along the new curve
  std::vector<Curve> joined;
  double along = 0, before = 0;
  const bool line = straight(parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    const double own = parts[k].length();
    const double after = line || last ? 0 : std::min({round, own / 3, parts[k + 1].length() / 3});
    joined.push_back(cutOff(parts[k], before, after));
    along += own - before - after;
    if (last) break;
    if (after > kNoPart) {
      const Curve &in = joined.back(), out = cutOff(parts[k + 1], after, 0);
      const double handle = after * 2 / 3;
      joined.push_back(Curve::cubic(in.end, in.end + normalized(in.tangent(1)) * handle,
                                    out.start - normalized(out.tangent(0)) * handle, out.start));
      const double over = joined.back().length();
      ends.push_back(along + over / 2), along += over;
    } else {
      ends.push_back(along);
    }
    before = after;
  }
  Led made{line ? Curve::line(parts.front().start, parts.back().end) : Curve::joined(joined), {{0, 0}}};
  if (olds.front()[0] > 0) made.shares.push_back({olds.front()[0], kHair});
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    made.shares.push_back({olds[k][1], ends[k] / along});
    if (olds[k + 1][0] > olds[k][1]) made.shares.push_back({olds[k + 1][0], ends[k] / along + kHair});
  }
  if (olds.back()[1] < 1) made.shares.push_back({olds.back()[1], 1 - kHair});
  made.shares.push_back({1, 1});
  return made;
}

class Slashing {
 public:
  Slashing(const Piece& piece, const Slash& slash) : piece_(piece), slash_(slash), edges_(piece.outline.edges) {}

  Result<OpenedPiece> opened() {
    if (Done done = place(); !done) return done.error();
    if (Done done = clear(); !done) return done.error();
    decide();
    parts_.opening = Opening(a_, b_, slash_.by, slash_.toBy, stays_);
    Piece now = piece_;
    now.outline = {};
    if (foldsOut()) {
      auto edges = foldedEdges();
      if (!edges) return edges.error();
      now.outline.edges = *std::move(edges);
    } else {
      for (std::size_t k = 0; k < edges_.size(); ++k) now.outline.edges.push_back({edges_[k].name, edge(k)});
    }
    for (std::size_t k = 0; k < edges_.size(); ++k)  // corners are met to the last bit
      now.outline.edges[(k + 1) % edges_.size()].curve.start = now.outline.edges[k].curve.end;
    auto good = checked(std::move(now.outline));
    if (!good) return good.error();
    now.outline = *std::move(good);
    for (Outline& hole : now.holes) {
      const bool ahead = parts_.isAhead(hole.edges.front().curve.start);
      for (Edge& one : hole.edges) one.curve = parts_.motion(ahead)(one.curve);
      const Ring ring = hole.flattened(1e-4);
      if (foldsOut() && std::any_of(ring.begin(), ring.end(), [&](Flat p) { return inside(p, ahead) < 0; }))
        return refused(say("A hole of {0} lies where the paper is folded out.", piece_.name));
    }
    for (InternalLine& line : now.lines)
      if (Done done = foldsOut() ? foldLine(line) : lead(line); !done) return done.error();
    for (Mark& mark : now.marks)
      if (mark.edge.empty()) mark.place = parts_(mark.place);
    followMarks(now, map_);
    if (piece_.form) now.form = stretched(*piece_.form);
    return OpenedPiece{{std::move(now), std::move(map_)}, stays_, std::move(parts_)};
  }

 private:
  Done place() {
    const auto i = piece_.outline.find(slash_.from), j = piece_.outline.find(slash_.to);
    if (!i || !j) return noEdge(piece_, i ? slash_.to : slash_.from);
    from_ = *i, to_ = *j;
    if (from_ == to_) return refused(say("A slash leads from one edge to another."));
    if (!(slash_.at >= 0 && slash_.at <= 1 && slash_.toAt >= 0 && slash_.toAt <= 1))
      return refused(say("A place on an edge lies between 0, its beginning, and 1, its end."));
    const auto cornered = [&](std::size_t k, double at) {
      const double whole = edges_[k].curve.length();
      return at * whole < kAtCorner ? 0 : (1 - at) * whole < kAtCorner ? 1 : at;
    };
    at_ = cornered(from_, slash_.at), toAt_ = cornered(to_, slash_.toAt);
    a_ = edges_[from_].curve.atFraction(at_), b_ = edges_[to_].curve.atFraction(toAt_);
    const double whole = distance(a_, b_);
    if (whole < kAtCorner) return refused(say("The slash begins and ends at one place, {0} mm.", inMm(a_)));
    const bool folded = slash_.by <= 0 && slash_.toBy <= 0, opened = slash_.by >= 0 && slash_.toBy >= 0;
    if (!(opened || folded) || !(std::abs(slash_.by) <= 1 && std::abs(slash_.toBy) <= 1))
      return refused(say("A slash is opened at both ends, or folded out at both (less than 0), by at most 1 m."));
    if (slash_.by == 0 && slash_.toBy == 0) return refused(say("A slash is opened, or folded out, by more than 0."));
    if (std::abs(slash_.by - slash_.toBy) > whole)
      return refused(say("The slash is {0} mm long; it cannot open by {1} mm more at one end than at the other.",
                         inMm(whole), inMm(std::abs(slash_.by - slash_.toBy))));
    return {};
  }

  // The slash lies in the piece and meets nothing but the two edges.
  Done clear() {
    const Flat along = normalized(b_ - a_);
    const std::vector<Flat> line{a_ + along * kWay, b_ - along * kWay};
    std::vector<Meeting> met;
    meetings(line, piece_.outline, met);
    if (!met.empty()) {
      const auto first =
          std::min_element(met.begin(), met.end(), [](const Meeting& x, const Meeting& y) { return x.at < y.at; });
      const std::string& meets = edges_[first->on.edge].name;
      if (meets == slash_.to || meets == slash_.from)
        return refused(say(
            "From “{0}” to “{1}” the paper cannot be cut straight: it comes to “{2}” before, at {3} mm. Name the part "
            "of “{2}” that lies opposite, as {2}@0:0.5, or the place of a single slash.",
            slash_.from, slash_.to, meets, inMm(first->place)));
      return refused(say("From “{0}” to “{1}” the paper cannot be cut straight: “{2}” is in the way, at {3} mm.",
                         slash_.from, slash_.to, meets, inMm(first->place)));
    }
    if (!contains(piece_.outline.flattened(1e-5), lerp(a_, b_, 0.5)))
      return refused(say("From “{0}” to “{1}” the paper cannot be cut straight: the line runs beside it.", slash_.from,
                         slash_.to));
    for (const Outline& hole : piece_.holes) meetings(line, hole, met);
    if (!met.empty())
      return refused(say("The slash would run into a hole of {0} at {1} mm.", piece_.name, inMm(met.front().place)));
    const auto walk = [&](Flat start, std::size_t first, double begin, std::size_t last, double end) {
      Ring ring{start};
      const auto add = [&](const Curve& curve) {
        for (const Flat p : curve.flattened(1e-5))
          if (distance(p, ring.back()) > kNoPart) ring.push_back(p);
      };
      for (std::size_t k = first;; k = (k + 1) % edges_.size()) {
        const Curve& curve = edges_[k].curve;
        const double t0 = k == first ? parameter(curve, begin) : 0, t1 = k == last ? parameter(curve, end) : 1;
        if (t1 - t0 > 1e-12) add(t0 == 0 && t1 == 1 ? curve : curve.part(t0, t1));
        if (k == last) break;
      }
      return ring;
    };
    parts_.ahead = walk(a_, from_, at_, to_, toAt_);
    parts_.behind = walk(b_, to_, toAt_, from_, at_);
    if (std::min(std::abs(signedArea(parts_.ahead)), std::abs(signedArea(parts_.behind))) < 1e-6)
      return refused(say("The slash runs along the outline of {0}; there is nothing to move beside it.", piece_.name));
    return {};
  }

  static double parameter(const Curve& curve, double share) {
    return share == 0 || share == 1 ? share : curve.parameterAt(share * curve.length());
  }

  void decide() {
    stays_ = slash_.stays;
    if (stays_ == Slash::Stays::Larger)
      stays_ = signedArea(parts_.ahead) > signedArea(parts_.behind) ? Slash::Stays::Ahead : Slash::Stays::Behind;
  }

  double rounded(bool first) const {
    if (!slash_.smooth || (first && slash_.folded)) return 0;
    return std::min(kRounded, std::max(std::abs(slash_.by), std::abs(slash_.toBy)) / 2);
  }

  void keepMap(const std::string& name, const Led& led) {
    auto& parts = map_[{piece_.id, name}];
    for (std::size_t k = 0; k + 1 < led.shares.size(); ++k)
      parts.push_back(
          {led.shares[k][0], led.shares[k + 1][0], {piece_.id, name, led.shares[k][1], led.shares[k + 1][1]}});
  }

  Curve edge(std::size_t k) {
    const Curve& curve = edges_[k].curve;
    if (k != from_ && k != to_) {
      const bool ahead = (k + edges_.size() - from_) % edges_.size() < (to_ + edges_.size() - from_) % edges_.size();
      const Curve moved = parts_.motion(ahead)(curve);
      for (const bool first : {true, false})
        if (const auto atStart = sharesCorner(k, first))
          return atCorner(edges_[k].name, moved, !*atStart, middleOf(first ? a_ : b_));
      return moved;
    }
    // The edge where the slash begins goes on from the part behind into the one ahead, the other one back.
    const bool first = k == from_;
    const double at = first ? at_ : toAt_, t = parameter(curve, at);
    const Motion &before = parts_.motion(!first), &after = parts_.motion(first);
    std::vector<Curve> parts;
    std::vector<double> from;
    const Flat corner = first ? a_ : b_;
    if (at > 0) parts.push_back(before(at == 1 ? curve : curve.part(0, t))), from.push_back(0);
    if (at < 1) parts.push_back(after(at == 0 ? curve : curve.part(t, 1))), from.push_back(at);
    if ((first ? slash_.by : slash_.toBy) == 0 && parts.size() == 1) return parts.front();  // hinged in a corner
    if (parts.size() == 1)
      return atCorner(edges_[k].name, parts.front(), at == 1,
                      slash_.shared ? middleOf(corner) : (at == 1 ? after : before)(corner));
    parts[0].end = before(corner), parts[1].start = after(corner);
    const Led now = led(parts, from, rounded(first), slash_.folded);
    keepMap(edges_[k].name, now);
    return now.curve;
  }

  // Whether an edge has half of the opening in the corner where the slash begins (ends): at its own start, or its end.
  std::optional<bool> sharesCorner(std::size_t k, bool first) const {
    const std::size_t n = edges_.size(), named = first ? from_ : to_;
    const double at = first ? at_ : toAt_;
    if (!slash_.shared || (first ? slash_.by : slash_.toBy) == 0) return std::nullopt;
    if (at == 1 && k == (named + 1) % n) return true;
    if (at == 0 && k == (named + n - 1) % n) return false;
    return std::nullopt;
  }
  Flat middleOf(Flat corner) const { return lerp(parts_.motion(true)(corner), parts_.motion(false)(corner), 0.5); }

  // An edge at whose end the slash lies takes the opening on.
  Curve atCorner(const std::string& name, const Curve& part, bool atEnd, Flat other) {
    std::vector<Curve> parts{part, Curve::line(part.end, other)};
    if (!atEnd) parts = {Curve::line(other, part.start), part};
    const double whole = parts[0].length() + parts[1].length(), own = part.length() / whole;
    Led now{straight(parts) ? Curve::line(parts[0].start, parts[1].end) : Curve::joined(parts), {}};
    if (atEnd)
      now.shares = {{0, 0}, {1 - kHair, own}, {1, 1}};
    else
      now.shares = {{0, 0}, {kHair, 1 - own}, {1, 1}};
    keepMap(name, now);
    return now.curve;
  }

  // --- What is folded out. The two parts lie double between the slash as it is ahead and as it is behind; the paper
  // meets in the middle of that.
  bool foldsOut() const { return slash_.by < 0 || slash_.toBy < 0; }
  // How far a place lies within what stays of its part; less than 0: it is folded out.
  double inside(Flat p, bool ahead) const {
    const Flat start = middleOf(a_), along = normalized(middleOf(b_) - start);
    return dot(p - start, leftOf(along)) * (ahead ? -1 : 1);
  }
  // What stays of a curve that ends (begins) in what is folded out, and where on it that is; nothing: none of it.
  std::optional<double> staysUpTo(const Curve& curve, bool ahead, bool end) const {
    constexpr int kSteps = 400;
    const auto in = [&](double t) { return inside(curve.at(t), ahead) >= 0; };
    const double last = end ? 1 : 0;
    if (in(last)) return last;
    for (int i = 1; i <= kSteps; ++i) {
      double good = end ? 1 - static_cast<double>(i) / kSteps : static_cast<double>(i) / kSteps;
      if (!in(good)) continue;
      double bad = good + (end ? 1.0 : -1.0) / kSteps;
      for (int k = 0; k < 60; ++k) (in((good + bad) / 2) ? good : bad) = (good + bad) / 2;
      return good;
    }
    return std::nullopt;
  }

  struct Run {  // a part of an edge, moved
    std::array<double, 2> old;
    bool ahead;
    Curve curve;
    std::array<int, 2> meets{-1, -1};  // 0, 1: where it begins and ends the paper is folded out, where the slash does
  };
  std::vector<Run> runsOf(std::size_t k) const {
    const std::size_t n = edges_.size();
    const Curve& curve = edges_[k].curve;
    std::vector<Run> runs;
    const auto add = [&](double from, double to, bool ahead) {
      const double t0 = parameter(curve, from), t1 = parameter(curve, to);
      runs.push_back({{from, to}, ahead, parts_.motion(ahead)(t0 == 0 && t1 == 1 ? curve : curve.part(t0, t1))});
    };
    if (k == from_ || k == to_) {
      const double at = k == from_ ? at_ : toAt_;
      if (at > 0) add(0, at, k == to_);
      if (at < 1) add(at, 1, k == from_);
      if (runs.size() == 2 && (k == from_ ? slash_.by : slash_.toBy) != 0)
        runs[0].meets[1] = runs[1].meets[0] = k == from_ ? 0 : 1;
    } else {
      add(0, 1, (k + n - from_) % n < (to_ + n - from_) % n);
    }
    for (const int end : {0, 1}) {  // a slash in a corner
      const std::size_t named = end == 0 ? from_ : to_;
      const double at = end == 0 ? at_ : toAt_;
      if ((end == 0 ? slash_.by : slash_.toBy) == 0 || (at != 0 && at != 1)) continue;
      const std::size_t before = at == 1 ? named : (named + n - 1) % n;
      if (k == before) runs.back().meets[1] = end;
      if (k == (before + 1) % n) runs.front().meets[0] = end;
    }
    return runs;
  }

  Result<std::vector<Edge>> foldedEdges() {
    std::vector<std::vector<Run>> all;
    std::array<std::vector<Flat>, 2> met;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      all.push_back(runsOf(k));
      for (Run& run : all.back())
        for (const bool end : {false, true}) {
          if (run.meets[end] < 0) continue;
          const auto t = staysUpTo(run.curve, run.ahead, end);
          if (!t || *t == (end ? 0 : 1))
            return refused(say("So much cannot be folded out: it would take all of “{0}”.", edges_[k].name));
          const double whole = run.curve.length(), wide = run.old[1] - run.old[0];
          const double away = run.curve.lengthTo(*t) / whole;
          (end ? run.old[1] : run.old[0]) = run.old[0] + wide * away;
          if (*t != (end ? 1 : 0)) run.curve = end ? run.curve.part(0, *t) : run.curve.part(*t, 1);
          met[static_cast<std::size_t>(run.meets[end])].push_back(end ? run.curve.end : run.curve.start);
        }
    }
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      std::vector<Curve> parts;
      std::vector<std::array<double, 2>> olds;
      for (Run& run : all[k]) {
        for (const bool end : {false, true})
          if (run.meets[end] >= 0) {
            const std::vector<Flat>& both = met[static_cast<std::size_t>(run.meets[end])];
            (end ? run.curve.end : run.curve.start) = lerp(both.front(), both.back(), 0.5);
          }
        parts.push_back(run.curve), olds.push_back(run.old);
      }
      const bool whole = parts.size() == 1 && olds.front()[0] == 0 && olds.front()[1] == 1;
      if (whole) {
        edges.push_back({edges_[k].name, parts.front()});
        continue;
      }
      const Led now = together(std::move(parts), olds, rounded(k == from_));
      keepMap(edges_[k].name, now);
      edges.push_back({edges_[k].name, now.curve});
    }
    return edges;
  }

  Done foldLine(InternalLine& line) {
    for (Curve& curve : line.curves) {
      std::vector<Curve> parts;
      std::vector<std::array<double, 2>> olds;
      const auto found = partsAcross(curve, {a_, b_});
      for (std::size_t k = 0; k < found.size(); ++k) {
        const double from = found[k].first, to = k + 1 < found.size() ? found[k + 1].first : 1;
        const bool ahead = parts_.isAhead(found[k].second.at(0.5));
        const Curve moved = parts_.motion(ahead)(found[k].second);
        const auto t0 = staysUpTo(moved, ahead, false), t1 = staysUpTo(moved, ahead, true);
        if (!t0 || !t1 || *t1 - *t0 < 1e-9) continue;
        const double whole = moved.length();
        olds.push_back(
            {from + (to - from) * moved.lengthTo(*t0) / whole, from + (to - from) * moved.lengthTo(*t1) / whole});
        parts.push_back(*t0 == 0 && *t1 == 1 ? moved : moved.part(*t0, *t1));
      }
      if (parts.empty())
        return refused(say("“{0}” lies where the paper is folded out; take the line away first.", line.name));
      if (parts.size() == 1 && olds.front()[0] == 0 && olds.front()[1] == 1) {
        curve = parts.front();
        continue;
      }
      const Led now = together(std::move(parts), olds, 0);
      if (line.curves.size() == 1 && !findEdge(piece_, line.name)) keepMap(line.name, now);
      curve = now.curve;
    }
    for (std::size_t k = 0; k + 1 < line.curves.size(); ++k)
      if (distance(line.curves[k].end, line.curves[k + 1].start) > kWay)
        return refused(
            say("A corner of “{0}” lies where the paper is folded out; take the line away first.", line.name));
    return {};
  }

  Done lead(InternalLine& line) {
    for (Curve& curve : line.curves) {
      const auto found = partsAcross(curve, {a_, b_});
      std::vector<Curve> parts;
      std::vector<double> from;
      for (const auto& [share, part] : found)
        parts.push_back(parts_.motion(parts_.isAhead(part.at(0.5)))(part)), from.push_back(share);
      if (parts.size() == 1) {
        curve = parts.front();
        continue;
      }
      const Led now = led(parts, from, 0);
      if (line.curves.size() == 1 && !findEdge(piece_, line.name)) keepMap(line.name, now);
      curve = now.curve;
    }
    return {};
  }

  // Where the paper of the form is now: as it was moved, and beside the slash evenly between, so that the cloth over
  // the opening comes from a wider strip and is not all folded into one line.
  std::shared_ptr<const Form> stretched(const Form& form) const {
    const double band = kBand * std::max(std::abs(slash_.by), std::abs(slash_.toBy));
    const auto reach = [&](const Ring& ring) {
      double most = 0;
      for (const Flat p : ring) most = std::max(most, distanceToSegment(a_, b_, p));
      return std::min(most, band);
    };
    const double ahead = reach(parts_.ahead), behind = reach(parts_.behind);
    auto now = std::make_shared<Form>(form);
    for (Flat& p : now->flat) {
      const double away = distanceToSegment(a_, b_, p) * (parts_.isAhead(p) ? 1 : -1);
      const double share = std::clamp((away + behind) / (ahead + behind), 0.0, 1.0);
      p = lerp(parts_.opening.behind(p), parts_.opening.ahead(p), share);
    }
    return now;
  }

  const Piece& piece_;
  const Slash& slash_;
  const std::vector<Edge>& edges_;
  std::size_t from_ = 0, to_ = 0;
  double at_ = 0, toAt_ = 0;
  Flat a_, b_;
  Parts parts_;
  Slash::Stays stays_ = Slash::Stays::Larger;
  EdgeMap map_;
};

}  // namespace

Slash mirrored(const Slash& slash, const std::string& from, const std::string& to) {
  Slash image = slash;
  image.from = from, image.to = to;
  image.at = 1 - slash.at, image.toAt = 1 - slash.toAt;
  if (slash.stays == Slash::Stays::Ahead) image.stays = Slash::Stays::Behind;
  if (slash.stays == Slash::Stays::Behind) image.stays = Slash::Stays::Ahead;
  return image;
}

Result<OpenedPiece> spreadPiece(const Piece& piece, const Slash& slash) { return Slashing(piece, slash).opened(); }

Slash::Stays staying(const Outline& outline, const Slash& slash, const std::function<bool(const std::string&)>& kept) {
  const std::size_t n = outline.edges.size(), from = *outline.find(slash.from), to = *outline.find(slash.to);
  bool ahead = false, behind = false;
  for (std::size_t k = 0; k < n; ++k)
    if (k != from && k != to && kept(outline.edges[k].name))
      ((k + n - from) % n < (to + n - from) % n ? ahead : behind) = true;
  if (slash.stays != Slash::Stays::Larger || ahead == behind) return slash.stays;
  return ahead ? Slash::Stays::Ahead : Slash::Stays::Behind;
}

bool meet(const Outline& outline, const Slash& one, const Slash& other) {
  const auto ends = [&](const Slash& slash) {
    return std::array{outline.edges[*outline.find(slash.from)].curve.atFraction(slash.at),
                      outline.edges[*outline.find(slash.to)].curve.atFraction(slash.toAt)};
  };
  const auto [a, b] = ends(one);
  const auto [c, d] = ends(other);
  const bool hinged = one.toBy == 0 && other.toBy == 0 && distance(b, d) < kAtCorner;
  const Flat back = hinged ? normalized(a - b) * (2 * kAtCorner) : Flat{};
  double along = 0;
  return segmentMeets(a, b + back, c, d, along).has_value();
}

}  // namespace karinui
