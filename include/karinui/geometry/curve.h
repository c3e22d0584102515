#pragma once
// A piece of a pattern's edge: a straight line, a cubic Bézier (or a chain of them) or a circular arc, in exact
// doubles. Metres on paper. Where it starts is the end of the curve before it, so a Curve is only meaningful with its
// two ends. Pure; any thread.
#include <array>
#include <span>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

struct Curve {
  enum class Kind { Line, Cubic, Arc };
  Kind kind = Kind::Line;
  Flat start, end;
  Flat control1, control2;  // Cubic: the first control and the last
  double bulge = 0;         // Arc: tan(quarter of the turned angle); > 0 turns left (counter-clockwise)
  // Cubic: empty for a single one. A chain of n has n - 1 joints; for each, in order, the control before it, the joint
  // and the control after it.
  std::vector<Flat> between;
  bool operator==(const Curve&) const = default;

  static Curve line(Flat a, Flat b) { return {Kind::Line, a, b, {}, {}, 0, {}}; }
  static Curve cubic(Flat a, Flat c1, Flat c2, Flat b) { return {Kind::Cubic, a, b, c1, c2, 0, {}}; }
  static Curve arc(Flat a, Flat b, double bulge) { return {Kind::Arc, a, b, {}, {}, bulge, {}}; }
  // Curves joined end to end as one: a single curve stays what it is, several become a chain of cubics.
  static Curve joined(std::span<const Curve> curves);

  std::vector<Curve> parts() const;   // a chain's single cubics; of any other curve itself
  std::vector<Curve> cubics() const;  // the same curve in single cubics; an arc within 1e-7 of its radius

  // t in [0, 1], the curve's own parameter; each cubic of a chain of n takes 1 / n of it.
  Flat at(double t) const;
  Flat tangent(double t) const;                                              // d/dt
  double length() const;                                                     // to 1e-9 m
  double lengthTo(double t) const;                                           // of the part [0, t]
  double parameterAt(double s) const;                                        // s in [0, length]; inverse of lengthTo
  Flat atFraction(double f) const { return at(parameterAt(f * length())); }  // f by length
  // atFraction of each, much sooner, to 1e-9 m (beside a cusp 1e-6 m).
  std::vector<Flat> atFractions(std::span<const double> fractions) const;
  // Of steps + 1 fractions from `from` to `to`, equally far along the curve.
  std::vector<Flat> evenly(double from, double to, int steps) const;
  Curve part(double t0, double t1) const;  // exact; t0 < t1
  Curve reversed() const;
  Curve mirrored(Flat through, Flat unitAxis) const;
  Curve rotated(Flat about, double radians) const;  // counter-clockwise
  // Points along the curve with no chord further than `miss` from it, start and end included.
  std::vector<Flat> flattened(double miss = 1e-5) const;
};

// The unit tangent at an end of a curve, also where a handle has no length: the direction of what follows it.
Flat endTangent(const Curve& curve, bool atEnd);

}  // namespace karinui
