// Whether a hand-drawn edge wavers, and the fair line in its stead.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

// Second differences as springs, places held weakly where they were; both ends of the run stay, and where their
// direction is kept, so do the places next to them.
std::vector<Curve> withoutWaves(std::span<const Curve> run, double shortest, KeptDirections kept) {
  std::vector<Flat> p;
  std::vector<std::size_t> joints;  // in p: where one curve ends and the next begins
  double length = 0;
  for (const Curve& curve : run) {
    const std::vector<Flat> own = placesOf(curve, shortest / kFine);
    p.insert(p.end(), own.begin() + (p.empty() ? 0 : 1), own.end());
    joints.push_back(p.size() - 1);
    length += curve.length();
  }
  const std::vector<Flat> was = p;
  const std::size_t n = p.size();
  const double stiff = std::pow(shortest / (2 * std::numbers::pi * length / static_cast<double>(n - 1)), 4);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = kept.atStart ? 2 : 1; i + (kept.atEnd ? 2 : 1) < n; ++i) {
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
    const double turn = std::atan2(cross(in, out), dot(in, out));
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
  do fair = withoutWaves(run, shortest, kept), shortest *= 1.5;
  while (wavering() && shortest < 4 * length);
  return fair;
}

}  // namespace karinui
