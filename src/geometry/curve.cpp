#include "karinui/geometry/curve.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/result.h"

namespace karinui {
namespace {

// Gauss-Legendre, 8 points on [-1, 1] (Abramowitz & Stegun, table 25.4).
constexpr std::array<double, 4> kPlace = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                          0.9602898564975363};
constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};

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

Flat turned(Flat a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.u - s * a.v, s * a.u + c * a.v};
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
  // Newton's steps, kept between what is surely too little and surely too much.
  double low = 0, high = 1, t = s / whole;
  for (int round = 0; round < 80; ++round) {
    const double miss = lengthTo(t) - s;
    if (std::abs(miss) < 1e-13) break;
    (miss > 0 ? high : low) = t;
    const double speed = karinui::length(tangent(t));
    const double next = speed > 0 ? t - miss / speed : -1;
    t = next > low && next < high ? next : (low + high) / 2;
    if (high - low < 1e-16) break;
  }
  return t;
}

Curve Curve::part(double t0, double t1) const {
  KARINUI_ASSERT(t0 < t1);
  if (t0 <= 0 && t1 >= 1) return *this;
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

Curve Curve::reversed() const { return {kind, end, start, control2, control1, kind == Kind::Arc ? -bulge : bulge}; }

Curve Curve::mirrored(Flat through, Flat unitAxis) const {
  const auto image = [&](Flat p) {
    const Flat d = p - through;
    return through + unitAxis * (2 * dot(d, unitAxis)) - d;
  };
  Curve mirror = *this;
  mirror.start = image(start);
  mirror.end = image(end);
  if (kind == Kind::Cubic) {
    mirror.control1 = image(control1);
    mirror.control2 = image(control2);
  }
  if (kind == Kind::Arc) mirror.bulge = -bulge;
  return mirror;
}

std::vector<Flat> Curve::flattened(double miss) const {
  KARINUI_ASSERT(miss > 0);
  double parts = 1;
  if (kind == Kind::Cubic) {
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
  const auto count = static_cast<std::size_t>(std::clamp(parts, 1.0, 1e5));
  std::vector<Flat> points(count + 1);
  for (std::size_t k = 0; k <= count; ++k) points[k] = at(static_cast<double>(k) / static_cast<double>(count));
  return points;
}

}  // namespace karinui
