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
  cubic.p1 = startWay ? p0 + *startWay * std::fmax(x[0], 0.05 * reach) : p0 + Flat{x[0], x[1]};
  cubic.p2 = endWay ? p3 + *endWay * std::fmax(x[2], 0.05 * reach) : p3 + Flat{x[2], x[3]};
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
  OneFit best;
  best.cubic = {points.front(), lerp(points.front(), points.back(), 1.0 / 3),
                lerp(points.front(), points.back(), 2.0 / 3), points.back()};
  best.miss = bow(points);
  best.worst = points.size() / 2;
  double bestScore = 1e300;
  double lastScore = 1e300;
  Cubic before{};
  for (int round = 0; round < 100; ++round) {
    OneFit now;
    now.cubic = before = leastSquares(points, t, startWay, endWay, round < 30 ? nullptr : &before);
    for (int k = 0; k < 3; ++k) reparametrise(now.cubic, points, t);
    now.worst = points.size() / 2;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double d = distance(now.cubic.at(t[i]), points[i]);
      if (d > now.miss) {
        now.miss = d;
        now.worst = i;
      }
    }
    const double score = 2 * now.miss + std::fabs(lengthOf(now.cubic) - whole);
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

// The direction of the points at an inner one, from a few on either side.
Flat wayAt(std::span<const Flat> points, std::size_t i) {
  const std::size_t reach = std::min({std::size_t{3}, i, points.size() - 1 - i});
  return normalized(points[i + reach] - points[i - reach]);
}

void fitRun(std::span<const Flat> points, const Flat* startWay, const Flat* endWay, double tolerance, Fitted& out) {
  const OneFit one = fitOne(points, startWay, endWay);
  if (one.miss <= tolerance || points.size() < 7) {
    out.curves.push_back(Curve::cubic(one.cubic.p0, one.cubic.p1, one.cubic.p2, one.cubic.p3));
    out.miss = std::fmax(out.miss, one.miss);
    return;
  }
  const std::size_t split = std::clamp(one.worst, std::size_t{3}, points.size() - 4);
  const Flat way = wayAt(points, split), back = -way;
  fitRun(points.subspan(0, split + 1), startWay, &back, tolerance, out);
  fitRun(points.subspan(split), &way, endWay, tolerance, out);
}

// A fixed number of cubics, of equal length, joined smoothly.
void fitPieces(std::span<const Flat> points, const Flat* startWay, const Flat* endWay, int pieces, Fitted& out) {
  std::vector<std::size_t> joint{0};
  const std::vector<double> t = chordParameters(points);
  for (int k = 1; k < pieces; ++k) {
    const auto after = std::lower_bound(t.begin(), t.end(), static_cast<double>(k) / pieces);
    const auto i = static_cast<std::size_t>(after - t.begin());
    if (i > joint.back() + 1 && i + 2 < points.size()) joint.push_back(i);
  }
  joint.push_back(points.size() - 1);
  std::vector<Flat> way(joint.size());
  for (std::size_t k = 1; k + 1 < joint.size(); ++k) {  // the direction over a third of the shorter neighbour
    const std::size_t reach = std::max<std::size_t>(1, std::min(joint[k] - joint[k - 1], joint[k + 1] - joint[k]) / 3);
    way[k] = normalized(points[joint[k] + reach] - points[joint[k] - reach]);
  }
  for (std::size_t k = 0; k + 1 < joint.size(); ++k) {
    const Flat back = -way[k + 1];
    const Flat* start = k == 0 ? startWay : &way[k];
    const Flat* end = k + 2 == joint.size() ? endWay : &back;
    const OneFit one = fitOne(points.subspan(joint[k], joint[k + 1] - joint[k] + 1), start, end);
    out.curves.push_back(Curve::cubic(one.cubic.p0, one.cubic.p1, one.cubic.p2, one.cubic.p3));
    out.miss = std::fmax(out.miss, one.miss);
  }
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
  const Flat into = endWay ? -*endWay : Flat{};
  const Flat *start = startWay ? &*startWay : nullptr, *end = endWay ? &into : nullptr;
  if (settings.pieces > 0) {
    fitPieces(points, start, end, settings.pieces, out);
    return out;
  }
  const OneFit one = fitOne(points, start, end);
  if (one.miss <= std::fmax(settings.single, settings.tolerance)) {
    out.curves.push_back(Curve::cubic(one.cubic.p0, one.cubic.p1, one.cubic.p2, one.cubic.p3));
    out.miss = one.miss;
    return out;
  }
  fitRun(points, start, end, settings.tolerance, out);
  return out;
}

}  // namespace karinui
