#include "karinui/geometry/fit_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/result.h"

namespace karinui {
namespace {

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

struct Cubic {
  Flat p0, p1, p2, p3;
  Flat at(double t) const {
    const auto b = bernstein(t);
    return p0 * b[0] + p1 * b[1] + p2 * b[2] + p3 * b[3];
  }
  Flat slope(double t) const {
    const double s = 1 - t;
    return ((p1 - p0) * (s * s) + (p2 - p1) * (2 * s * t) + (p3 - p2) * (t * t)) * 3;
  }
  Flat bend(double t) const { return ((p2 - p1 * 2 + p0) * (1 - t) + (p3 - p2 * 2 + p1) * t) * 6; }
};

std::vector<double> chordParameters(std::span<const Flat> points) {
  std::vector<double> t(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i) t[i] = t[i - 1] + distance(points[i - 1], points[i]);
  if (t.back() > 0)
    for (double& x : t) x /= t.back();
  return t;
}

// Control points by least squares for given parameters. An end whose tangent is fixed (unit, pointing into the curve)
// keeps its control point on that ray; a free end's may lie anywhere.
// `before`, the curve so far, makes distances count across it and hardly along it (tangent distance, Blake & Isard
// 1998): points may then slide along the curve, and a few rounds find what thousands would otherwise.
Cubic leastSquares(std::span<const Flat> points, const std::vector<double>& t, const Flat* startWay, const Flat* endWay,
                   const Cubic* before) {
  const Flat p0 = points.front(), p3 = points.back();
  const double reach = distance(p0, p3) / 3;
  // Unknowns: control1 = p0 + (startWay ? a * way : (a, b)), control2 likewise with (c, d).
  double m[4][5] = {};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const auto b = bernstein(t[i]);
    const Flat miss = points[i] - p0 * (b[0] + b[1]) - p3 * (b[2] + b[3]);
    const Flat column[4] = {startWay ? *startWay * b[1] : Flat{b[1], 0}, startWay ? Flat{} : Flat{0, b[1]},
                            endWay ? *endWay * b[2] : Flat{b[2], 0}, endWay ? Flat{} : Flat{0, b[2]}};
    const Flat across = before ? leftOf(normalized(before->slope(t[i]))) : Flat{};
    const auto metric = [&](Flat x, Flat y) {
      return before ? dot(x, across) * dot(y, across) + 0.01 * dot(x, y) : dot(x, y);
    };
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) m[r][c] += metric(column[r], column[c]);
      m[r][4] += metric(column[r], miss);
    }
  }
  const double small = 1e-9 + 1e-9 * static_cast<double>(points.size());
  const Flat chord = normalized(p3 - p0) * reach;  // the straight cubic, towards which what is undecided goes
  const double rest[4] = {startWay ? reach : chord.u, startWay ? 0 : chord.v, endWay ? reach : -chord.u,
                          endWay ? 0 : -chord.v};
  for (int r = 0; r < 4; ++r) {
    m[r][r] += small;
    m[r][4] += small * rest[r];
  }
  for (int c = 0; c < 4; ++c) {
    int pivot = c;
    for (int r = c + 1; r < 4; ++r)
      if (std::fabs(m[r][c]) > std::fabs(m[pivot][c])) pivot = r;
    std::swap(m[c], m[pivot]);
    for (int r = 0; r < 4; ++r) {
      if (r == c) continue;
      const double f = m[r][c] / m[c][c];
      for (int k = c; k < 5; ++k) m[r][k] -= f * m[c][k];
    }
  }
  double x[4];
  for (int r = 0; r < 4; ++r) x[r] = m[r][4] / m[r][r];
  Cubic cubic{p0, {}, {}, p3};
  // A control point behind its end would make a hook.
  cubic.p1 = startWay ? p0 + *startWay * std::fmax(x[0], 0.15 * reach) : p0 + Flat{x[0], x[1]};
  cubic.p2 = endWay ? p3 + *endWay * std::fmax(x[2], 0.15 * reach) : p3 + Flat{x[2], x[3]};
  return cubic;
}

// One Newton step of each parameter towards the nearest place on the curve (Schneider 1990).
void reparametrise(const Cubic& cubic, std::span<const Flat> points, std::vector<double>& t) {
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Flat miss = cubic.at(t[i]) - points[i], d = cubic.slope(t[i]), dd = cubic.bend(t[i]);
    const double below = dot(d, d) + dot(miss, dd);
    if (below > 0) t[i] = std::clamp(t[i] - dot(miss, d) / below, 0.0, 1.0);
  }
}

bool crossesItself(const Cubic& cubic) {
  constexpr int kParts = 48;
  Flat p[kParts + 1];
  for (int i = 0; i <= kParts; ++i) p[i] = cubic.at(static_cast<double>(i) / kParts);
  const auto turn = [](Flat a, Flat b, Flat c) { return cross(b - a, c - a); };
  for (int i = 0; i < kParts; ++i)
    for (int j = i + 2; j < kParts; ++j)
      if (turn(p[i], p[i + 1], p[j]) * turn(p[i], p[i + 1], p[j + 1]) < 0 &&
          turn(p[j], p[j + 1], p[i]) * turn(p[j], p[j + 1], p[i + 1]) < 0)
        return true;
  return false;
}

struct OneFit {
  Cubic cubic;
  double miss = 0;
  std::size_t worst = 0;
};
OneFit fitOne(std::span<const Flat> points, const Flat* startWay, const Flat* endWay) {
  std::vector<double> t = chordParameters(points);
  // A seam's length matters as much as its course: of all rounds the one nearest in both is kept.
  double whole = 0;
  for (std::size_t i = 1; i < points.size(); ++i) whole += distance(points[i - 1], points[i]);
  const auto lengthOf = [](const Cubic& cubic) {
    double sum = 0;
    for (int i = 0; i < 64; ++i) sum += distance(cubic.at(i / 64.0), cubic.at((i + 1) / 64.0));
    return sum;
  };
  const auto scored = [&](const Cubic& cubic) {
    OneFit fit{cubic, 0, points.size() / 2};
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      if (const double d = distance(cubic.at(t[i]), points[i]); d > fit.miss) fit.miss = d, fit.worst = i;
    return fit;
  };
  const auto scoreOf = [&](const OneFit& fit) { return 2 * fit.miss + std::fabs(lengthOf(fit.cubic) - whole); };
  // With few points between, least squares may swing far out along the given tangents: handles of a third of the chord
  // are what it has to beat.
  const Flat first = points.front(), last = points.back();
  const double third = distance(first, last) / 3;
  Cubic plain{first, startWay ? first + *startWay * third : lerp(first, last, 1.0 / 3),
              endWay ? last + *endWay * third : lerp(first, last, 2.0 / 3), last};
  for (int k = 0; k < 3; ++k) reparametrise(plain, points, t);
  OneFit best = scored(plain);
  t = chordParameters(points);
  double bestScore = scoreOf(best);
  double lastScore = 1e300;
  Cubic before{};
  for (int round = 0; round < 100; ++round) {
    before = leastSquares(points, t, startWay, endWay, round < 30 ? nullptr : &before);
    for (int k = 0; k < 3; ++k) reparametrise(before, points, t);
    const OneFit now = scored(before);
    const double score = scoreOf(now);
    if (score < bestScore && !crossesItself(now.cubic)) {
      best = now;
      bestScore = score;
    }
    if (round > 30 && round % 20 == 19) {
      if (bestScore > 0.98 * lastScore) break;
      lastScore = bestScore;
    }
  }
  return best;
}

// The direction of the points at an inner one, from those on either side: two, or as many as lie within `near` metres.
Flat wayAt(std::span<const Flat> points, std::size_t i, double near) {
  const std::size_t most = std::min(i, points.size() - 1 - i);
  std::size_t reach = std::min<std::size_t>(2, most);
  while (reach < most && distance(points[i + reach + 1], points[i - reach - 1]) < 2 * near) ++reach;
  return normalized(points[i + reach] - points[i - reach]);
}

// The direction of the points from their first one on, within `near` metres of it.
Flat wayFrom(std::span<const Flat> points, double near) {
  std::size_t i = 1;
  while (i + 1 < points.size() && distance(points[0], points[i]) < near) ++i;
  return normalized(points[i] - points[0]);
}

// Cubics from point `from` to point `to` within the tolerance, divided where one alone is furthest off (Schneider
// 1990).
struct Chain {
  std::span<const Flat> points;
  const FitSettings& settings;
  double miss = 0;
  std::vector<Curve> curves;

  void fit(std::size_t from, std::size_t to, const Flat* startWay, const Flat* endWay) {
    const OneFit one = fitOne(points.subspan(from, to - from + 1), startWay, endWay);
    const std::size_t least = std::min<std::size_t>(2, (to - from) / 2);
    const double shortest = settings.shortest;
    std::size_t first = from + least, last = to - least;
    while (first < last && distance(points[from], points[first]) < shortest) ++first;
    while (first < last && distance(points[last], points[to]) < shortest) --last;
    const bool roomy =
        distance(points[from], points[first]) >= shortest && distance(points[last], points[to]) >= shortest;
    if (!roomy) first = from + least, last = to - least;
    if (one.miss <= (roomy ? settings.tolerance : settings.farthest) || to - from < 2) {
      curves.push_back(Curve::cubic(one.cubic.p0, one.cubic.p1, one.cubic.p2, one.cubic.p3));
      miss = std::fmax(miss, one.miss);
      return;
    }
    const std::size_t split = std::clamp(from + one.worst, first, last);
    const Flat way = wayAt(points, split, roomy ? shortest / 2 : 0), back = -way;
    fit(from, split, startWay, &back);
    fit(split, to, &way, endWay);
  }
};

// Where a fixed number of curves of equal length meet.
std::vector<std::size_t> jointsOf(std::span<const Flat> points, int pieces) {
  std::vector<std::size_t> joint{0};
  const std::vector<double> t = chordParameters(points);
  for (int k = 1; k < pieces; ++k) {
    const auto after = std::lower_bound(t.begin(), t.end(), static_cast<double>(k) / pieces);
    const auto i = static_cast<std::size_t>(after - t.begin());
    if (i > joint.back() + 1 && i + 2 < points.size()) joint.push_back(i);
  }
  joint.push_back(points.size() - 1);
  return joint;
}

std::vector<Flat> withoutRepeats(std::span<const Flat> points) {
  std::vector<Flat> kept;
  for (Flat p : points)
    if (kept.empty() || distance(kept.back(), p) > 1e-9) kept.push_back(p);
  if (kept.size() > 1) kept.back() = points.back();
  return kept;
}

}  // namespace

double bow(std::span<const Flat> points) {
  const Flat a = points.front(), b = points.back();
  const double l2 = dot(b - a, b - a);
  double worst = 0;
  for (Flat p : points) {
    const double t = l2 > 0 ? std::clamp(dot(p - a, b - a) / l2, 0.0, 1.0) : 0;
    worst = std::fmax(worst, distance(p, lerp(a, b, t)));
  }
  return worst;
}

Fitted fitEdge(std::span<const Flat> given, const FitSettings& settings, const std::optional<Flat>& startWay,
               const std::optional<Flat>& endWay) {
  KARINUI_ASSERT(given.size() >= 2);
  const std::vector<Flat> points = withoutRepeats(given);
  Fitted out;
  if (points.size() < 3 || bow(points) < settings.straight) {
    out.curves.push_back(Curve::line(given.front(), given.back()));
    out.miss = bow(given);
    return out;
  }
  std::optional<Flat> from = startWay, into;
  if (endWay) into = -*endWay;
  if (settings.firmEnds > 0) {
    if (!from) from = wayFrom(points, settings.firmEnds);
    if (!into) into = wayFrom(std::vector<Flat>(points.rbegin(), points.rend()), settings.firmEnds);
  }
  const Flat *start = from ? &*from : nullptr, *end = into ? &*into : nullptr;
  const std::vector<std::size_t> joint = jointsOf(points, settings.pieces);
  for (std::size_t k = 0; k + 1 < joint.size(); ++k) {
    const bool first = k == 0, last = k + 2 == joint.size();
    const Flat way = first ? Flat{} : wayAt(points, joint[k], 0),
               back = last ? Flat{} : -wayAt(points, joint[k + 1], 0);
    Chain chain{points, settings, 0, {}};
    chain.fit(joint[k], joint[k + 1], first ? start : &way, last ? end : &back);
    out.curves.push_back(Curve::joined(chain.curves));
    out.miss = std::fmax(out.miss, chain.miss);
  }
  return out;
}

}  // namespace karinui
