#include "refit_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "karinui/geometry/fit_curve.h"
#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

constexpr double kSameCurve = 1e-6;                       // metres: parts of one curve
constexpr double kSmooth = 2 * std::numbers::pi / 180;    // radians between two that meet smoothly
constexpr double kSmoothMiss = 1e-4, kCornerMiss = 5e-4;  // metres the fit may pass from the places
constexpr double kSpacing = 0.002;                        // metres between the places an edge is measured at

bool same(const Curve& a, const Curve& b) {
  for (const double f : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
    if (distance(a.atFraction(f), b.atFraction(f)) > kSameCurve) return false;
  return true;
}

// The curve that two single curves are parts of.
std::optional<Curve> undivided(const Curve& first, const Curve& second) {
  if (first.kind != second.kind) return std::nullopt;
  switch (first.kind) {
    case Curve::Kind::Line:
      if (distanceToSegment(first.start, second.end, first.end) > kSameCurve) return std::nullopt;
      return Curve::line(first.start, second.end);
    case Curve::Kind::Arc: {
      const double turn = 4 * (std::atan(first.bulge) + std::atan(second.bulge));
      if (std::fabs(turn) > 6) return std::nullopt;
      const Curve whole = Curve::arc(first.start, second.end, std::tan(turn / 4));
      const double t = std::atan(first.bulge) / (std::atan(first.bulge) + std::atan(second.bulge));
      if (!(t > 0 && t < 1) || !same(whole.part(0, t), first) || !same(whole.part(t, 1), second)) return std::nullopt;
      return whole;
    }
    case Curve::Kind::Cubic: {
      // De Casteljau backwards: both handles at the joint are parts of one line, in the ratio it was divided in.
      const double in = distance(first.control2, first.end), out = distance(second.start, second.control1);
      if (!(in + out > kSameCurve)) return std::nullopt;
      const double t = in / (in + out);
      if (!(t > 1e-6 && t < 1 - 1e-6)) return std::nullopt;
      const Curve whole = Curve::cubic(first.start, first.start + (first.control1 - first.start) * (1 / t),
                                       second.end + (second.control2 - second.end) * (1 / (1 - t)), second.end);
      if (!same(whole.part(0, t), first) || !same(whole.part(t, 1), second)) return std::nullopt;
      return whole;
    }
  }
  return std::nullopt;
}

// Places along a part of a curve.
void measure(const Curve& curve, double from, double to, std::vector<Flat>& places) {
  const double whole = curve.length();
  const auto steps = static_cast<int>(std::clamp(std::ceil((to - from) * whole / kSpacing), 12.0, 300.0));
  for (const Flat place : curve.evenly(from, to, steps))
    if (places.empty() || distance(places.back(), place) > kSameCurve) places.push_back(place);
}

}  // namespace

Curve refitted(const Curve& first, const Curve& second) {
  if (first.kind == Curve::Kind::Line && second.kind == Curve::Kind::Line) return Curve::line(first.start, second.end);
  std::vector<Curve> chain = first.parts();
  const std::vector<Curve> rest = second.parts();
  if (const auto whole = undivided(chain.back(), rest.front())) {
    chain.back() = *whole;
    chain.insert(chain.end(), rest.begin() + 1, rest.end());
    return Curve::joined(chain);
  }
  chain.insert(chain.end(), rest.begin(), rest.end());
  const bool smooth = std::fabs(angleFrom(endTangent(first, true), endTangent(second, false))) < kSmooth;
  const double one = first.length(), other = second.length(), off = smooth ? 0 : std::min(one, other) / 3;
  std::vector<Flat> places;
  measure(first, 0, 1 - off / one, places);
  measure(second, off / other, 1, places);
  FitSettings fit;
  fit.straight = 0;
  fit.tolerance = fit.farthest = smooth ? kSmoothMiss : kCornerMiss;
  fit.shortest = 0.01;
  const Fitted fitted = fitEdge(places, fit, endTangent(first, false), endTangent(second, true));
  const Curve made = Curve::joined(fitted.curves);
  // What is smooth already is not divided further only to be rounded.
  if (smooth && (fitted.miss > kSmoothMiss || made.parts().size() >= Curve::joined(chain).parts().size()))
    return Curve::joined(chain);
  return made;
}

}  // namespace karinui
