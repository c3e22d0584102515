#include "design/operations/recut_outline.h"

#include <algorithm>
#include <cmath>

#include "karinui/geometry/fit_curve.h"

namespace karinui {
namespace {

constexpr double kStill = 1e-5;      // metres: what moved less did not move
constexpr double kAcross = 2e-4;     // an end that leaves a straight edge's line by less stays on it
constexpr double kStraight = 0.002;  // a straight edge stays straight while it bows less
constexpr double kPeak = 0.1;        // and while no pull between its ends stands out by more than this share
constexpr double kSample = 0.004;    // metres between the places an edge is measured at

// By how much the furthest moved place between the ends stands out from both sides.
double peak(const std::vector<Flat>& by) {
  std::vector<double> before(by.size()), behind(by.size());
  for (std::size_t i = 0; i < by.size(); ++i)
    before[i] = i == 0 ? length(by[0]) : std::min(before[i - 1], length(by[i]));
  for (std::size_t i = by.size(); i-- > 0;)
    behind[i] = i + 1 == by.size() ? length(by[i]) : std::min(behind[i + 1], length(by[i]));
  double most = 0;
  for (std::size_t i = 0; i < by.size(); ++i) most = std::max(most, length(by[i]) - std::max(before[i], behind[i]));
  return most;
}

struct Measured {
  Curve was;
  Flat startBy, endBy;
  std::vector<double> t;  // parameters of the samples
  std::vector<Flat> by;
  std::size_t first = 0, last = 0;  // the samples between which it moved
  enum class Fate { Stays, Straight, Anew } fate = Fate::Stays;
  Flat startWay, endWay;  // Anew: unit, as the edge runs
  bool freeStart() const { return fate == Fate::Anew && first == 0; }
  bool freeEnd() const { return fate == Fate::Anew && last + 1 == by.size(); }
};

Measured measured(const Curve& was, const std::function<Flat(Flat)>& shift, Flat startBy, Flat endBy, bool angles) {
  Measured m{was, startBy, endBy, {}, {}, 0, 0, Measured::Fate::Stays, {}, {}};
  const auto steps = static_cast<int>(std::clamp(std::ceil(was.length() / kSample), 6.0, 400.0));
  const double whole = was.length();
  double most = 0;
  for (int i = 0; i <= steps; ++i) {
    m.t.push_back(i == steps ? 1 : was.parameterAt(whole * i / steps));
    m.by.push_back(i == 0 ? startBy : i == steps ? endBy : shift(was.at(m.t.back())));
    if (length(m.by.back()) < kStill) m.by.back() = {};
    most = std::max(most, length(m.by.back()));
  }
  if (most == 0) return m;
  const std::size_t n = m.by.size() - 1;
  m.first = n;
  for (std::size_t i = 0; i <= n; ++i)
    if (m.by[i] != Flat{}) m.first = std::min(m.first, i), m.last = i;
  // One place beyond that stayed is enough to begin from; a fit needs a few in all.
  m.first = m.first > 0 ? m.first - 1 : 0;
  m.last = std::min(n, m.last + 1);
  while (m.last - m.first < 4) m.last < n ? ++m.last : --m.first;
  m.fate = Measured::Fate::Anew;
  if (was.kind == Curve::Kind::Line) {
    double bow = 0;
    for (std::size_t i = 0; i <= n; ++i)
      bow = std::max(bow, length(m.by[i] - lerp(startBy, endBy, static_cast<double>(i) / static_cast<double>(n))));
    if (bow < kStraight || peak(m.by) < std::max(5e-4, kPeak * most)) m.fate = Measured::Fate::Straight;
  }
  const auto wayBy = [&](std::size_t at, std::size_t next) {
    return normalized(was.at(m.t[next]) + m.by[next] - was.at(m.t[at]) - m.by[at]);
  };
  m.startWay = wayBy(0, 1), m.endWay = wayBy(n - 1, n);
  if (!angles) return m;
  // An end turns as the cloth at it turned.
  m.startWay = turned(endTangent(was, false), angleFrom(was.at(m.t[1]) - was.start, m.startWay));
  m.endWay = turned(endTangent(was, true), angleFrom(was.end - was.at(m.t[n - 1]), m.endWay));
  return m;
}

// Ends that hardly leave a straight edge's line stay on it, so that what is parallel or square remains so.
void keepLines(const Outline& old, std::vector<Flat>& by) {
  const std::size_t n = old.edges.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Curve& curve = old.edges[k].curve;
    if (curve.kind != Curve::Kind::Line) continue;
    const Flat across = leftOf(normalized(curve.end - curve.start));
    for (Flat* b : {&by[k], &by[(k + 1) % n]})
      if (const double off = dot(*b, across); std::abs(off) < kAcross) *b -= across * off;
  }
}

// What is cut anew meets its neighbours at the angle it met them at.
void keepAngles(std::vector<Measured>& edges) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Measured &a = edges[k], &b = edges[(k + 1) % edges.size()];
    if (!a.freeEnd() && !b.freeStart()) continue;
    const Flat oldA = endTangent(a.was, true), oldB = endTangent(b.was, false);
    const double turn = angleFrom(oldA, oldB);
    const auto fixed = [](const Measured& m, bool end) {
      if (m.fate == Measured::Fate::Straight) return normalized(m.was.end + m.endBy - m.was.start - m.startBy);
      return endTangent(m.was, end);
    };
    if (a.freeEnd() && b.freeStart()) {
      const double together = (angleFrom(oldA, a.endWay) + angleFrom(oldB, b.startWay)) / 2;
      a.endWay = turned(oldA, together);
      b.startWay = turned(oldB, together);
    } else if (a.freeEnd()) {
      a.endWay = turned(fixed(b, false), -turn);
    } else {
      b.startWay = turned(fixed(a, true), turn);
    }
  }
}

Curve cutAnew(const Measured& m) {
  if (m.fate == Measured::Fate::Stays) return m.was;
  if (m.fate == Measured::Fate::Straight) return Curve::line(m.was.start + m.startBy, m.was.end + m.endBy);
  std::vector<Flat> points;
  for (std::size_t i = m.first; i <= m.last; ++i) points.push_back(m.was.at(m.t[i]) + m.by[i]);
  FitSettings fit;
  fit.straight = 0;
  fit.tolerance = 0.0003;
  fit.farthest = 0.002;
  fit.shortest = 0.03;  // the shift is known from triangle to triangle: shorter cubics would follow their edges
  const Flat startWay = m.first == 0 ? m.startWay : normalized(m.was.tangent(m.t[m.first]));
  const Flat endWay = m.last + 1 == m.by.size() ? m.endWay : normalized(m.was.tangent(m.t[m.last]));
  std::vector<Curve> run;
  if (m.first > 0) run.push_back(m.was.part(0, m.t[m.first]));
  for (const Curve& curve : fitEdge(points, fit, startWay, endWay).curves) run.push_back(curve);
  if (m.last + 1 < m.by.size()) run.push_back(m.was.part(m.t[m.last], 1));
  return Curve::joined(run);
}

}  // namespace

Outline recutOutline(const Outline& old, const std::function<Flat(Flat)>& shift, bool angles) {
  const std::size_t n = old.edges.size();
  std::vector<Flat> cornerBy;
  for (const Edge& edge : old.edges) {
    const Flat by = shift(edge.curve.start);
    cornerBy.push_back(length(by) < kStill ? Flat{} : by);
  }
  keepLines(old, cornerBy);
  std::vector<Measured> edges;
  for (std::size_t k = 0; k < n; ++k)
    edges.push_back(measured(old.edges[k].curve, shift, cornerBy[k], cornerBy[(k + 1) % n], angles));
  if (angles) keepAngles(edges);
  Outline outline = old;
  for (std::size_t k = 0; k < n; ++k) {
    outline.edges[k].curve = cutAnew(edges[k]);
    // The banks of a slit are one line walked both ways.
    for (std::size_t other = 0; other < k; ++other)
      if (old.edges[other].curve == old.edges[k].curve.reversed())
        outline.edges[k].curve = outline.edges[other].curve.reversed();
  }
  return outline;
}

FollowEdge::FollowEdge(const Curve& was, const Curve& is) : was_(was.length()), is_(is.length()) {
  const double shorter = std::min(was_, is_);
  const auto same = [](const Curve& a, const Curve& b, double s) {
    return distance(a.at(a.parameterAt(s)), b.at(b.parameterAt(s))) < 1e-6;
  };
  const Curve wasBack = was.reversed(), isBack = is.reversed();
  constexpr double kStep = 0.002;
  while (head_ + kStep < shorter && same(was, is, head_ + kStep)) head_ += kStep;
  if (head_ + 2 * kStep >= shorter && was_ == is_) head_ = was_;
  while (head_ + tail_ + kStep < shorter && same(wasBack, isBack, tail_ + kStep)) tail_ += kStep;
}

double FollowEdge::operator()(double fraction) const {
  const double s = fraction * was_;
  if (s <= head_) return s / is_;
  if (s >= was_ - tail_) return 1 - (was_ - s) / is_;
  return (head_ + (s - head_) / (was_ - head_ - tail_) * (is_ - head_ - tail_)) / is_;
}

}  // namespace karinui
