#include "karinui/pattern/edge_length.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"
#include "words.h"

namespace karinui {
namespace {

constexpr double kEdgeTurns = 10 * kDegree;       // that the edge may turn for its neighbour's sake
constexpr double kNeighbourTurns = 20 * kDegree;  // that the neighbour may turn itself
constexpr double kOnAxis = 2e-5;                  // metres
constexpr double kMostTurned = 15 * kDegree;      // that an end turns to keep its angle
constexpr double kLeastBeside = 2e-3;             // metres: that an edge beside it keeps

// Where an end may go: the places at one distance from a place, or on a line.
struct Locus {
  bool line = false;
  Flat at, way;  // of a circle the centre; of a line one place, and its direction (unit)
  double radius = 0;
};
std::vector<Flat> meet(const Locus& a, const Locus& b) {
  if (a.line && b.line) return {};
  if (a.line) return meet(b, a);
  if (b.line) {
    const Flat to = a.at - b.at;
    const double along = dot(to, b.way), off = cross(b.way, to), left = a.radius * a.radius - off * off;
    if (left < 0) return {};
    const double half = std::sqrt(left);
    return {b.at + b.way * (along - half), b.at + b.way * (along + half)};
  }
  const Flat between = b.at - a.at;
  const double d = length(between);
  if (!(d > 1e-9)) return {};
  const double along = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
  const double left = a.radius * a.radius - along * along;
  if (left < 0) return {};
  const Flat way = between * (1 / d), foot = a.at + way * along, off = leftOf(way) * std::sqrt(left);
  return {foot + off, foot - off};
}

// The curve turned, scaled and carried so that it runs between these places.
Curve between(const Curve& curve, Flat start, Flat end) {
  const Flat was = curve.end - curve.start, is = end - start;
  const double ww = dot(was, was), c = dot(was, is) / ww, s = cross(was, is) / ww;
  const auto carried = [&](Flat p) {
    const Flat d = p - curve.start;
    return start + Flat{c * d.u - s * d.v, s * d.u + c * d.v};
  };
  Curve now = curve;
  if (now.kind == Curve::Kind::Cubic) {
    now.control1 = carried(curve.control1), now.control2 = carried(curve.control2);
    for (Flat& p : now.between) p = carried(p);
  }
  now.start = start, now.end = end;
  return now;
}

// One end of an edge moves; what lies at it follows. `end`: the edge's own end, else its start.
class MovedEnd {
 public:
  MovedEnd(const Outline& outline, std::size_t k, bool end, const PaperSymmetry* symmetry)
      : outline_(outline), symmetry_(symmetry), k_(k), end_(end), n_(outline.edges.size()) {
    const Curve& curve = outline.edges[k].curve;
    stays_ = end ? curve.start : curve.end;
    moves_ = end ? curve.end : curve.start;
    next_ = end ? (k + 1) % n_ : (k + n_ - 1) % n_;
    const Curve& neighbour = outline.edges[next_].curve;
    far_ = end ? neighbour.end : neighbour.start;
    across_ = symmetry && symmetry->partner[k] == k;
    slides_ = symmetry && !across_ && onAxis(moves_);
  }

  // Where the end goes if its length becomes `to`; none: it cannot.
  std::optional<Flat> place(double to, bool neighbourKeeps, bool& keeps) const {
    const double ratio = to / outline_.edges[k_].curve.length();
    const Flat chord = moves_ - stays_;
    keeps = false;
    if (across_) {  // scaled about its middle; it may be carried along the axis
      const Flat middle = (moves_ + stays_) * 0.5, plain = middle + (moves_ - middle) * ratio;
      if (neighbourKeeps)
        if (const auto there = best({true, plain, symmetry_->axis, 0}, neighbourLocus(), plain, false)) {
          keeps = true;
          return there;
        }
      return plain;
    }
    const Flat plain = stays_ + chord * ratio;
    const Locus own{false, stays_, {}, length(chord) * ratio};
    if (slides_) return best(own, {true, moves_, symmetry_->axis, 0}, plain, true);
    if (neighbourKeeps)
      if (const auto there = best(own, neighbourLocus(), plain, true)) {
        keeps = true;
        return there;
      }
    return plain;
  }

  Result<Outline> to(double length, bool neighbourKeeps) const {
    const Edge& edge = outline_.edges[k_];
    if (!(distance(moves_, stays_) > 1e-6))
      return refused(say("Edge {0} ends where it starts; its length cannot be typed.", edge.name));
    bool keeps = false;
    const auto there = place(length, neighbourKeeps, keeps);
    if (!there)
      return refused(say(
          "The end of {0} on the centre line cannot slide so far that it becomes {1} mm long; let the other end move.",
          edge.name, inMm(length)));
    Outline now = outline_;
    const auto set = [&](std::size_t e, bool atEnd, Flat place) {
      const std::size_t after = atEnd ? (e + 1) % n_ : e, before = (after + n_ - 1) % n_;
      now.edges[after].curve.start = now.edges[before].curve.end = place;
    };
    Curve& neighbour = now.edges[next_].curve;
    const Curve was = neighbour;
    const Flat by = *there - moves_;
    const bool selfNeighbour = symmetry_ && symmetry_->partner[next_] == next_ && next_ != k_;
    if (across_) {
      const Flat other = symmetry_->image(*there);
      now.edges[k_].curve = end_ ? between(edge.curve, other, *there) : between(edge.curve, *there, other);
      if (keeps)
        neighbour = end_ ? between(was, *there, far_) : between(was, far_, *there);
      else
        follow(neighbour, end_, by);
      set(k_, end_, *there);
      set(k_, !end_, other);
    } else {
      now.edges[k_].curve = end_ ? between(edge.curve, stays_, *there) : between(edge.curve, *there, stays_);
      if (slides_ && symmetry_->partner[k_] == next_) {
        neighbour = symmetry_->image(now.edges[k_].curve).reversed();
      } else if (selfNeighbour) {  // both its ends go
        follow(neighbour, end_, by);
        follow(neighbour, !end_, symmetry_->imageOf(by));
        if (keeps)
          for (Flat& p : neighbour.between) p += by;
        set(next_, end_, symmetry_->image(*there));
      } else if (keeps && farSlides()) {
        follow(neighbour, end_, by);
        follow(neighbour, !end_, by);
        for (Flat& p : neighbour.between) p += by;
        set(next_, end_, far_ + by);
        set(k_, end_, *there);
        now.edges[beyond()].curve = symmetry_->image(neighbour).reversed();  // all of it goes, not its end alone
      } else if (keeps) {
        neighbour = end_ ? between(was, *there, far_) : between(was, far_, *there);
      } else {
        follow(neighbour, end_, by);
      }
      set(k_, end_, *there);
    }
    if (symmetry_) now = onBothHalves(outline_, std::move(now), *symmetry_);
    return checked(std::move(now));
  }

  Result<Outline> along(double by) const {
    const Edge &edge = outline_.edges[k_], &next = outline_.edges[next_];
    if (slides_ || next_ == k_ || (symmetry_ && symmetry_->partner[k_] == next_))
      return refused(say("An end of {0} lies on the centre line, and cannot go along the edge beside it.", edge.name));
    const bool both = symmetry_ && symmetry_->partner[next_] == next_;  // its ends both go
    const double whole = next.curve.length();
    if (by > (both ? whole / 2 : whole) - kLeastBeside)
      return refused(
          say("{0} is {1} mm long: the end of {2} cannot go so far along it.", next.name, inMm(whole), edge.name));
    Curve way = end_ ? next.curve : next.curve.reversed();  // it begins at the end that goes
    if (by >= 0) {
      way = way.part(way.parameterAt(by), both ? way.parameterAt(whole - by) : 1);
    } else {
      const Flat step = endTangent(way, false) * by, other = both ? symmetry_->imageOf(step) : Flat{};
      follow(way, true, step), follow(way, false, other);
      way.start += step, way.end += other;
    }
    const Flat there = way.start;
    Outline now = outline_;
    const Flat stays = across_ ? symmetry_->image(there) : stays_;
    now.edges[k_].curve = end_ ? between(edge.curve, stays, there) : between(edge.curve, there, stays);
    now.edges[next_].curve = end_ ? way : way.reversed();
    if (symmetry_) now = onBothHalves(outline_, std::move(now), *symmetry_);
    for (std::size_t e = 0; e < n_; ++e) now.edges[e].curve.end = now.edges[(e + 1) % n_].curve.start;  // to the bit
    return checked(std::move(now));
  }

  bool slides() const { return slides_; }
  bool canSlide() const {
    bool keeps = false;
    return !slides_ || place(outline_.edges[k_].curve.length() * 1.02, false, keeps).has_value();
  }

 private:
  bool onAxis(Flat place) const { return distance(symmetry_->image(place), place) < kOnAxis; }
  // The neighbour's far end lies on the axis, and its image begins there.
  bool farSlides() const { return symmetry_ && onAxis(far_) && symmetry_->partner[next_] == beyond(); }
  std::size_t beyond() const { return end_ ? (next_ + 1) % n_ : (next_ + n_ - 1) % n_; }
  Locus neighbourLocus() const {
    if (symmetry_ && !across_ && (symmetry_->partner[next_] == next_ || farSlides()))
      return {true, moves_, symmetry_->axis, 0};
    return {false, far_, {}, distance(moves_, far_)};
  }
  // The place on both that is nearest to the plain one, if nothing turns too far for it.
  std::optional<Flat> best(const Locus& own, const Locus& other, Flat plain, bool edgeTurns) const {
    std::optional<Flat> found;
    for (const Flat place : meet(own, other))
      if (!found || distance(place, plain) < distance(*found, plain)) found = place;
    if (!found) return std::nullopt;
    if (edgeTurns && std::fabs(angleFrom(moves_ - stays_, *found - stays_)) > kEdgeTurns) return std::nullopt;
    if (!other.line && std::fabs(angleFrom(moves_ - far_, *found - far_)) > kNeighbourTurns) return std::nullopt;
    return found;
  }
  // The near control goes along with the end; a straight line and an arc need none.
  static void follow(Curve& curve, bool start, Flat by) {
    if (curve.kind != Curve::Kind::Cubic) return;
    (start ? curve.control1 : curve.control2) += by;
  }

  const Outline& outline_;
  const PaperSymmetry* symmetry_;
  std::size_t k_, next_ = 0;
  bool end_;
  std::size_t n_;
  Flat stays_, moves_, far_;
  bool across_ = false, slides_ = false;
};

}  // namespace

bool canMoveEnd(const Outline& outline, std::size_t edge, bool end, const PaperSymmetry* symmetry) {
  return MovedEnd(outline, edge, end, symmetry).canSlide();
}

Result<Outline> withLength(const Outline& outline, const LengthChange& change, const PaperSymmetry* symmetry) {
  const auto k = outline.find(change.edge);
  if (!k) return notFound(say("The outline has no edge {0}.", change.edge));
  const double was = outline.edges[*k].curve.length();
  const bool across = symmetry && symmetry->partner[*k] == *k;
  if (across && change.keep != KeptEnd::Middle)
    return refused(say(
        "Edge {0} crosses the centre of a symmetric piece, so both its ends move; write keep=middle, or symmetric=no.",
        change.edge));
  const auto moved = [&](const Outline& from, bool end, double to) {
    return MovedEnd(from, *from.find(change.edge), end, symmetry).to(to, change.neighboursKeep);
  };
  if (across || change.keep != KeptEnd::Middle)
    return moved(outline, across || change.keep == KeptEnd::Start, change.to);
  const auto half = moved(outline, true, (was + change.to) / 2);
  return half ? moved(*half, false, change.to) : half;
}

Result<Outline> withEndAlong(const Outline& outline, std::string_view edge, KeptEnd keep, double by,
                             const PaperSymmetry* symmetry) {
  const auto k = outline.find(edge);
  if (!k) return notFound(say("The outline has no edge {0}.", edge));
  const bool across = symmetry && symmetry->partner[*k] == *k;
  const auto moved = [&](const Outline& from, bool end) { return MovedEnd(from, *k, end, symmetry).along(by); };
  if (across || keep != KeptEnd::Middle) return moved(outline, across || keep == KeptEnd::Start);
  const auto half = moved(outline, true);
  return half ? moved(*half, false) : half;
}

Result<Outline> withAnglesOf(const Outline& was, Outline now, std::string_view edge, const PaperSymmetry* symmetry) {
  const auto k = now.find(edge);
  if (!k || was.edges.size() != now.edges.size()) return notFound(say("The outline has no edge {0}.", edge));
  Curve& curve = now.edges[*k].curve;
  if (curve.kind != Curve::Kind::Cubic) return now;
  const std::size_t n = now.edges.size(), before = (*k + n - 1) % n, after = (*k + 1) % n;
  const Outline as = now;
  const auto away = [&](const Outline& outline, bool atEnd) {  // of the edge, from the one beside it
    const Curve &own = outline.edges[*k].curve, &beside = outline.edges[atEnd ? after : before].curve;
    return angleFrom(endTangent(beside, !atEnd), endTangent(own, atEnd));
  };
  for (const bool atEnd : {false, true}) {
    const double turn = std::remainder(away(was, atEnd) - away(as, atEnd), 2 * std::numbers::pi);
    if (std::fabs(turn) > kMostTurned) continue;
    Flat& control = atEnd ? curve.control2 : curve.control1;
    const Flat about = atEnd ? curve.end : curve.start;
    control = Curve::line(control, control).rotated(about, turn).start;
  }
  if (symmetry)
    if (const auto other = symmetry->partner[*k]; other && *other != *k) {
      Curve image = symmetry->image(curve).reversed();
      image.start = now.edges[*other].curve.start, image.end = now.edges[*other].curve.end;
      now.edges[*other].curve = std::move(image);
    }
  return checked(std::move(now));
}

}  // namespace karinui
