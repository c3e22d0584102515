// Whether a hand-drawn edge wavers, and the fair line in its stead.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/design/drawing.h"
#include "karinui/geometry/fit_curve.h"

namespace karinui {
namespace {

constexpr double kFairStep = 0.004;                     // metres between the places that are looked at
constexpr double kSwing = 10 * std::numbers::pi / 180;  // a turn to one side that is seen
constexpr int kUsual = 3;                               // such turns a tailor's line may have: a sleeve's crown
constexpr double kShortest = 0.12;                      // metres: shorter waves are taken out first
constexpr double kFine = 25;                            // places to the shortest wave
constexpr int kSweeps = 2000;

std::vector<Flat> placesOf(const Curve& edge, double step) {
  return edge.evenly(0, 1, std::clamp(static_cast<int>(edge.length() / step), 8, 400));
}

// Second differences as springs, places held weakly where they were; both ends stay.
Curve withoutWaves(const Curve& edge, double shortest) {
  std::vector<Flat> p = placesOf(edge, shortest / kFine);
  const std::vector<Flat> was = p;
  const std::size_t n = p.size();
  const double stiff = std::pow(shortest / (2 * std::numbers::pi * edge.length() / static_cast<double>(n - 1)), 4);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = 1; i + 1 < n; ++i) {
      double bend = 0;
      Flat pull{};
      for (std::size_t k = std::max<std::size_t>(i - 1, 1); k <= std::min(i + 1, n - 2); ++k) {
        Flat rest{};
        for (std::size_t j = k - 1; j <= k + 1; ++j)
          if (j != i) rest += p[j] * (j == k ? -2.0 : 1.0);
        const double own = k == i ? -2 : 1;
        bend += own * own * stiff;
        pull = pull - rest * (own * stiff);
      }
      p[i] = (pull + was[i]) * (1 / (bend + 1));
    }
  FitSettings fit;
  fit.tolerance = 0.002;
  fit.shortest = 0.08;
  fit.farthest = 0.003;
  return Curve::joined(fitEdge(p, fit).curves);
}

}  // namespace

int wavers(const Curve& edge) {
  const std::vector<Flat> p = placesOf(edge, kFairStep);
  int turns = 0;
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Flat in = p[i] - p[i - 1], out = p[i + 1] - p[i];
    const double turn = std::atan2(cross(in, out), dot(in, out));
    if (turn * sum < 0 && std::fabs(sum) > kSwing) ++turns, sum = 0;
    // A flicker to the other side does not end a turn.
    sum = turn * sum < 0 && std::fabs(sum + turn) < std::fabs(turn) ? turn : sum + turn;
  }
  if (std::fabs(sum) > kSwing) ++turns;
  return std::max(0, turns - kUsual);
}

// Longer and longer waves are taken out until it wavers no more; a fair line stays as it is.
Curve fairEdge(const Curve& edge) {
  Curve fair = edge;
  for (double shortest = kShortest; wavers(fair) > 0 && shortest < 4 * edge.length(); shortest *= 1.5)
    fair = withoutWaves(edge, shortest);
  return fair;
}

}  // namespace karinui
