#include "karinui/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/base/result.h"

namespace karinui {
namespace {

// Gauss-Legendre, 8 points on [-1, 1] (Abramowitz & Stegun, table 25.4).
constexpr std::array<double, 4> kPlace = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                          0.9602898564975363};
constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};

// The cubics of a chain; every other curve counts as one.
std::size_t count(const Curve& curve) { return 1 + curve.between.size() / 3; }
Curve cubicOf(const Curve& chain, std::size_t k) {
  const auto& b = chain.between;
  const bool first = k == 0, last = k + 1 == count(chain);
  return Curve::cubic(first ? chain.start : b[3 * k - 2], first ? chain.control1 : b[3 * k - 1],
                      last ? chain.control2 : b[3 * k], last ? chain.end : b[3 * k + 1]);
}
// Which of a chain's cubics a parameter is on, and where on it.
struct Within {
  std::size_t k = 0;
  double t = 0;
};
Within within(const Curve& chain, double t) {
  const auto n = static_cast<double>(count(chain));
  const double along = std::clamp(t, 0.0, 1.0) * n;
  const double k = std::fmin(std::floor(along), n - 1);
  return {static_cast<std::size_t>(k), along - k};
}

double gauss(const Curve& curve, double from, double to) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (std::size_t k = 0; k < kPlace.size(); ++k)
    sum += kWeight[k] *
           (length(curve.tangent(middle - half * kPlace[k])) + length(curve.tangent(middle + half * kPlace[k])));
  return sum * half;
}

double cubicLength(const Curve& curve, double from, double to, double whole, int depth) {
  const double middle = (from + to) / 2;
  const double left = gauss(curve, from, middle), right = gauss(curve, middle, to);
  if (depth == 0 || std::abs(left + right - whole) < 1e-12) return left + right;
  return cubicLength(curve, from, middle, left, depth - 1) + cubicLength(curve, middle, to, right, depth - 1);
}

// The parameter in [from, to] by which the cubic has run s of the `whole` it is long there, within `close` metres.
double placeAfter(const Curve& cubic, double from, double to, double s, double whole, double close) {
  // Newton's steps, kept between what is surely too little and surely too much.
  double low = from, high = to, t = whole > 0 ? from + (to - from) * (s / whole) : from;
  for (int round = 0; round < 80; ++round) {
    const double miss = cubicLength(cubic, from, t, gauss(cubic, from, t), 24) - s;
    if (std::abs(miss) < close) break;
    (miss > 0 ? high : low) = t;
    const double speed = length(cubic.tangent(t));
    const double next = speed > 0 ? t - miss / speed : -1;
    t = next > low && next < high ? next : (low + high) / 2;
    if (high - low < 1e-16) break;
  }
  return t;
}

double turn(const Curve& arc) { return 4 * std::atan(arc.bulge); }  // of the whole arc, > 0 to the left

// An arc is as long as its chord, times this.
double arcOverChord(const Curve& arc) {
  const double half = turn(arc) / 2;
  return std::abs(half) < 1e-6 ? 1 + half * half / 6 : half / std::sin(half);
}

}  // namespace

Flat Curve::at(double t) const {
  if (t <= 0) return start;
  if (t >= 1) return end;
  if (!between.empty()) {
    const Within in = within(*this, t);
    return cubicOf(*this, in.k).at(in.t);
  }
  const double s = 1 - t;
  switch (kind) {
    case Kind::Line:
      return lerp(start, end, t);
    case Kind::Cubic:
      return s * s * s * start + 3 * s * s * t * control1 + 3 * s * t * t * control2 + t * t * t * end;
    case Kind::Arc: {
      // The chord from the start to here stands at half the angle turned so far from the first tangent, and is
      // 2 r sin(half that angle) long. Unlike a formula by centre and radius this stays exact when the arc is flat.
      const double half = turn(*this) / 2;
      const double grown = std::abs(half) < 1e-9 ? t : std::sin(t * half) / std::sin(half);
      return start + turned(end - start, -half * s) * grown;
    }
  }
  return start;
}

Flat Curve::tangent(double t) const {
  if (!between.empty()) {
    const Within in = within(*this, t);
    return cubicOf(*this, in.k).tangent(in.t) * static_cast<double>(count(*this));
  }
  const double s = 1 - t;
  switch (kind) {
    case Kind::Line:
      return end - start;
    case Kind::Cubic:
      return 3 * s * s * (control1 - start) + 6 * s * t * (control2 - control1) + 3 * t * t * (end - control2);
    case Kind::Arc:
      return turned(end - start, turn(*this) * (t - 0.5)) * arcOverChord(*this);
  }
  return {};
}

double Curve::length() const { return lengthTo(1); }

double Curve::lengthTo(double t) const {
  t = std::clamp(t, 0.0, 1.0);
  if (t == 0) return 0;
  if (!between.empty()) {
    const Within in = within(*this, t);
    double sum = 0;
    for (std::size_t k = 0; k < in.k; ++k) sum += cubicOf(*this, k).length();
    return sum + cubicOf(*this, in.k).lengthTo(in.t);
  }
  switch (kind) {
    case Kind::Line:
      return t * distance(start, end);
    case Kind::Cubic:
      return cubicLength(*this, 0, t, gauss(*this, 0, t), 24);
    case Kind::Arc:
      return t * distance(start, end) * arcOverChord(*this);
  }
  return 0;
}

double Curve::parameterAt(double s) const {
  const double whole = length();
  if (!(s > 0) || whole <= 0) return 0;
  if (s >= whole) return 1;
  if (kind != Kind::Cubic) return s / whole;
  if (!between.empty()) {
    const std::size_t n = count(*this);
    double left = s;
    for (std::size_t k = 0; k < n; ++k) {
      const Curve cubic = cubicOf(*this, k);
      const double own = cubic.length();
      if (left < own || k + 1 == n) return (static_cast<double>(k) + cubic.parameterAt(left)) / static_cast<double>(n);
      left -= own;
    }
  }
  return placeAfter(*this, 0, 1, s, whole, 1e-13);
}

std::vector<Flat> Curve::evenly(double from, double to, int steps) const {
  KARINUI_ASSERT(steps > 0);
  std::vector<double> fractions;
  for (int i = 0; i <= steps; ++i) fractions.push_back(from + (to - from) * i / steps);
  return atFractions(fractions);
}

std::vector<Flat> Curve::atFractions(std::span<const double> fractions) const {
  std::vector<Flat> places;
  places.reserve(fractions.size());
  if (kind != Kind::Cubic) {
    for (const double f : fractions) places.push_back(at(std::clamp(f, 0.0, 1.0)));
    return places;
  }
  // The lengths up to every eighth of each cubic; Newton's steps then have little left to measure.
  constexpr std::size_t kParts = 8;
  const std::vector<Curve> cubics = parts();
  std::vector<double> reached{0};
  for (const Curve& cubic : cubics)
    for (std::size_t k = 0; k < kParts; ++k) {
      const double low = static_cast<double>(k) / kParts, high = low + 1.0 / kParts;
      reached.push_back(reached.back() + cubicLength(cubic, low, high, gauss(cubic, low, high), 24));
    }
  for (const double f : fractions) {
    const double s = std::clamp(f, 0.0, 1.0) * reached.back();
    const auto past = std::upper_bound(reached.begin() + 1, reached.end() - 1, s);
    const auto cell = static_cast<std::size_t>(past - reached.begin()) - 1;
    const Curve& cubic = cubics[cell / kParts];
    const double low = static_cast<double>(cell % kParts) / kParts, high = low + 1.0 / kParts, own = s - reached[cell];
    const double t = placeAfter(cubic, low, high, own, reached[cell + 1] - reached[cell], 1e-10);
    places.push_back(cubic.at(t));
  }
  return places;
}

Curve Curve::part(double t0, double t1) const {
  KARINUI_ASSERT(t0 < t1);
  if (t0 <= 0 && t1 >= 1) return *this;
  if (!between.empty()) {
    const Within from = within(*this, t0), to = within(*this, t1);
    std::vector<Curve> kept;
    for (std::size_t k = from.k; k <= to.k; ++k) {
      const double a = k == from.k ? from.t : 0, b = k == to.k ? to.t : 1;
      if (b - a > 1e-9) kept.push_back(cubicOf(*this, k).part(a, b));
    }
    if (kept.empty()) return line(at(t0), at(t1));
    return joined(kept);
  }
  Curve piece = *this;
  piece.start = at(t0);
  piece.end = at(t1);
  if (kind == Kind::Arc) piece.bulge = std::tan(turn(*this) * (t1 - t0) / 4);
  if (kind == Kind::Cubic) {
    // A Bézier's end tangents give its controls; a change of parameter scales them by t1 - t0.
    piece.control1 = piece.start + tangent(t0) * ((t1 - t0) / 3);
    piece.control2 = piece.end - tangent(t1) * ((t1 - t0) / 3);
  }
  return piece;
}

Curve Curve::reversed() const {
  const double other = kind == Kind::Arc ? -bulge : bulge;
  return {kind, end, start, control2, control1, other, {between.rbegin(), between.rend()}};
}

namespace {

template <class Map>
Curve mapped(Curve curve, const Map& map) {
  curve.start = map(curve.start), curve.end = map(curve.end);
  if (curve.kind == Curve::Kind::Cubic) {
    curve.control1 = map(curve.control1), curve.control2 = map(curve.control2);
    for (Flat& p : curve.between) p = map(p);
  }
  return curve;
}

}  // namespace

Curve Curve::mirrored(Flat through, Flat unitAxis) const {
  Curve mirror = mapped(*this, [&](Flat p) {
    const Flat d = p - through;
    return through + unitAxis * (2 * dot(d, unitAxis)) - d;
  });
  if (kind == Kind::Arc) mirror.bulge = -bulge;
  return mirror;
}

Curve Curve::rotated(Flat about, double radians) const {
  const double c = std::cos(radians), s = std::sin(radians);
  return mapped(*this, [&](Flat p) {
    const Flat d = p - about;
    return about + Flat{d.u * c - d.v * s, d.u * s + d.v * c};
  });
}

std::vector<Flat> Curve::flattened(double miss) const {
  KARINUI_ASSERT(miss > 0);
  double parts = 1;
  if (!between.empty()) {
    // As many on each cubic, so that the points are evenly spaced in the chain's own parameter too.
    std::size_t most = 1;
    for (std::size_t k = 0; k < count(*this); ++k) most = std::max(most, cubicOf(*this, k).flattened(miss).size() - 1);
    parts = static_cast<double>(most * count(*this));
  } else if (kind == Kind::Cubic) {
    // A chord over dt is off by at most max|B''| dt^2 / 8; B'' runs straight between its two ends.
    const double bend =
        6 * std::max(karinui::length(start - 2 * control1 + control2), karinui::length(control1 - 2 * control2 + end));
    parts = std::ceil(std::sqrt(bend / (8 * miss)));
  } else if (kind == Kind::Arc && bulge != 0) {
    const double angle = std::abs(turn(*this));
    const double radius = length() / angle;
    // The chord of angle a is off by r (1 - cos(a/2)).
    const double widest = miss < 2 * radius ? 4 * std::asin(std::sqrt(miss / (2 * radius))) : angle;
    parts = std::ceil(angle / widest);
  }
  const auto chords = static_cast<std::size_t>(std::clamp(parts, 1.0, 1e5));
  std::vector<Flat> points(chords + 1);
  for (std::size_t k = 0; k <= chords; ++k) points[k] = at(static_cast<double>(k) / static_cast<double>(chords));
  return points;
}

Flat endTangent(const Curve& curve, bool atEnd) {
  for (const double t : {0.0, 1e-6, 1e-3, 0.1})
    if (const Flat way = curve.tangent(atEnd ? 1 - t : t); length(way) > 1e-9) return normalized(way);
  return normalized(curve.end - curve.start);
}

std::vector<Curve> Curve::parts() const {
  if (between.empty()) return {*this};
  std::vector<Curve> all;
  for (std::size_t k = 0; k < count(*this); ++k) all.push_back(cubicOf(*this, k));
  return all;
}

std::vector<Curve> Curve::cubics() const {
  if (kind == Kind::Cubic) return parts();
  if (kind == Kind::Line || bulge == 0)
    return {cubic(start, lerp(start, end, 1.0 / 3), lerp(start, end, 2.0 / 3), end)};
  // Of at most 22.5 degrees each: an arc of angle a has handles of 4/3 tan(a / 4) radii,
  // and the cubic then lies within 2e-6 a^6 radii of it (Goldapp 1991).
  const int n = std::max(1, static_cast<int>(std::ceil(std::abs(turn(*this)) / (std::numbers::pi / 8))));
  std::vector<Curve> all;
  for (int k = 0; k < n; ++k) {
    const Curve arc = part(static_cast<double>(k) / n, static_cast<double>(k + 1) / n);
    const double angle = turn(arc), radius = distance(arc.start, arc.end) / (2 * std::sin(std::abs(angle) / 2));
    const double handle = 4.0 / 3 * std::abs(arc.bulge) * radius;
    all.push_back(cubic(k == 0 ? start : all.back().end, arc.start + normalized(arc.tangent(0)) * handle,
                        arc.end - normalized(arc.tangent(1)) * handle, k + 1 == n ? end : arc.end));
  }
  return all;
}

Curve Curve::joined(std::span<const Curve> curves) {
  KARINUI_ASSERT(!curves.empty());
  if (curves.size() == 1) return curves.front();
  Curve chain;
  for (const Curve& curve : curves)
    for (const Curve& cubic : curve.cubics()) {
      if (chain.kind == Kind::Line) {
        chain = cubic;
        continue;
      }
      chain.between.insert(chain.between.end(), {chain.control2, chain.end, cubic.control1});
      chain.control2 = cubic.control2;
      chain.end = cubic.end;
    }
  return chain;
}

}  // namespace karinui
