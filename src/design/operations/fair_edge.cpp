// Whether a hand-drawn edge wavers, and the fair line in its stead.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "karinui/design/drawing.h"
#include "karinui/geometry/fair_points.h"
#include "karinui/geometry/fit_curve.h"

namespace karinui {
namespace {

constexpr double kFairStep = 0.004;                     // metres between the places that are looked at
constexpr double kSwing = 10 * std::numbers::pi / 180;  // a turn to one side that is seen
constexpr int kUsual = 3;                               // such turns a tailor's line may have: a sleeve's crown
constexpr double kShortest = 0.18;                      // metres: shorter waves are taken out first
constexpr double kFine = 25;                            // places to the shortest wave

std::vector<Flat> placesOf(const Curve& edge, double step) {
  return edge.evenly(0, 1, std::clamp(static_cast<int>(edge.length() / step), 8, 400));
}

std::vector<Curve> asOneLine(std::span<const Curve> run, double shortest, KeptDirections kept) {
  std::vector<Flat> places;
  std::vector<std::size_t> joints;  // where one curve ends and the next begins
  for (const Curve& curve : run) {
    const std::vector<Flat> own =
        curve.evenly(0, 1, std::clamp(static_cast<int>(std::lround(curve.length() * kFine / shortest)), 2, 400));
    places.insert(places.end(), own.begin() + (places.empty() ? 0 : 1), own.end());
    joints.push_back(places.size() - 1);
  }
  if (places.size() < 4) return {run.begin(), run.end()};
  const std::vector<Flat> p = withoutWaves(places, shortest, kept);
  const std::size_t n = p.size();
  FitSettings fit;
  fit.tolerance = 0.0005;
  fit.shortest = 0.06;
  fit.farthest = 0.001;
  std::vector<Curve> fair;
  std::optional<Flat> way, last;
  if (kept.atStart) way = normalized(run.front().tangent(0));
  if (kept.atEnd) last = normalized(run.back().tangent(1));
  std::size_t from = 0;
  for (const std::size_t to : joints) {
    const std::optional<Flat> next = to + 1 < n ? std::optional(normalized(p[to + 1] - p[to - 1])) : last;
    fair.push_back(Curve::joined(fitEdge(std::span(p).subspan(from, to + 1 - from), fit, way, next).curves));
    from = to, way = next;
  }
  return fair;
}

}  // namespace

int wavers(const Curve& edge) {
  const std::vector<Flat> p = placesOf(edge, kFairStep);
  int turns = 0;
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Flat in = p[i] - p[i - 1], out = p[i + 1] - p[i];
    const double turn = angleFrom(in, out);
    if (turn * sum < 0 && std::fabs(sum) > kSwing) ++turns, sum = 0;
    // A flicker to the other side does not end a turn.
    sum = turn * sum < 0 && std::fabs(sum + turn) < std::fabs(turn) ? turn : sum + turn;
  }
  if (std::fabs(sum) > kSwing) ++turns;
  return std::max(0, turns - kUsual);
}

// Longer and longer waves are taken out until no curve wavers.
std::vector<Curve> fairLine(std::span<const Curve> run, KeptDirections kept) {
  double length = 0;
  for (const Curve& curve : run) length += curve.length();
  std::vector<Curve> fair;
  const auto wavering = [&] {
    return std::any_of(fair.begin(), fair.end(), [](const Curve& c) { return wavers(c) > 0; });
  };
  double shortest = kShortest;
  do fair = asOneLine(run, shortest, kept), shortest *= 1.5;
  while (wavering() && shortest < 4 * length);
  return fair;
}

}  // namespace karinui
