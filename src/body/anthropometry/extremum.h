#pragma once
// The level at which a girth is largest or smallest, from evenly spaced samples. Pure functions, any thread.
#include <algorithm>
#include <cmath>
#include <vector>

namespace karinui {

struct GirthLevel {
  double girth = 0, y = 0;
};
enum class Extremum { Smallest, Largest };

// How far from the middle one of three evenly spaced samples the extremum of the parabola through them lies.
inline double parabolaPeak(double step, double before, double here, double after) {
  const double bend = before - 2 * here + after;
  return std::abs(bend) < 1e-12 ? 0 : step * std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
}

// The extremum of girth(y) over [low, high]: the best of `count` samples, refined between its neighbours.
template <class Girth>
GirthLevel extremum(Extremum which, double low, double high, int count, const Girth& girth) {
  const double step = (high - low) / (count - 1), sign = which == Extremum::Largest ? 1 : -1;
  std::vector<double> g(count);
  for (int i = 0; i < count; ++i) g[i] = girth(low + step * i);
  int best = 0;
  for (int i = 1; i < count; ++i)
    if (sign * g[i] > sign * g[best] && g[i] > 0) best = i;
  GirthLevel found{g[best], low + step * best};
  if (best > 0 && best + 1 < count) {
    const double y = found.y + parabolaPeak(step, g[best - 1], g[best], g[best + 1]);
    const double fine = girth(y);
    if (sign * fine > sign * found.girth) found = {fine, y};
  }
  return found;
}

// The same where the girth hardly changes over a hand's breadth: the mean of the levels, those within half a millimetre
// of the extremum weighing most, so that a hair's difference does not move the level by centimetres.
template <class Girth>
GirthLevel plateauExtremum(Extremum which, double low, double high, int count, const Girth& girth) {
  constexpr double kHair = 0.0005;  // metres
  const GirthLevel sharp = extremum(which, low, high, count, girth);
  double sum = 0, total = 0;
  for (int i = 0; i < count; ++i) {
    const double y = low + (high - low) * i / (count - 1), off = std::abs(girth(y) - sharp.girth) / kHair;
    const double weight = std::exp(-off);
    sum += weight * y, total += weight;
  }
  return {sharp.girth, total > 0 ? sum / total : sharp.y};
}

}  // namespace karinui
