#include "cloth/drape_progress.h"

#include <algorithm>
#include <cmath>

#include "cloth/rest_forecast.h"

namespace karinui {
namespace {

constexpr double kUsualSteps = 100;

int tens(double steps) { return 10 * std::max(1, static_cast<int>(std::lround(steps / 10))); }

}  // namespace

void ToldProgress::step(std::optional<double> left) {
  constexpr double kGrown = 1.2;  // times the lowest number told: the forecast holds no more
  share_ += (1 - share_) / (left.value_or(kUsualSteps) + 2);
  if (!left) return;
  const int now = tens(*left);
  if (!lowest_ || now < *lowest_) lowest_ = now;
  told_ = now <= kGrown * *lowest_ ? lowest_ : std::nullopt;
}

StepWatcher DrapeProgress::watch(const Level& level, Message doing, double from, double to) {
  const double start = level.begin + (level.end - level.begin) * from, span = (level.end - level.begin) * (to - from);
  return [this, &solver = level.solver, finest = level.finest, start, span, doing = std::move(doing),
          forecast = RestForecast(), told = ToldProgress(),
          left = std::optional<double>()](int step, const LevelSolver::StepResult& result) mutable {
    // As long as nothing shrinks, the number of steps left is not known and taken to be the usual one.
    forecast.add(result.work / solver.weight());
    if (const std::optional<double> now = forecast.stepsLeft())
      left = now;
    else if (left)
      left = std::fmax(0.0, *left - 1);
    if (left) left = std::fmin(*left, std::fmax(0.0, settings_.maxSteps - step));
    told.step(left);
    const auto steps = finest ? told.stepsToGo() : std::nullopt;
    token_.progress(start + span * told.share(),
                    steps ? say("{0}, some {1} {1|step|steps} to go", doing, *steps) : doing);
    if (watcher_) watcher_(solver.cloth(), solver.positions());
    const bool asked = settings_.stop && settings_.stop->askedAfterStep();
    return ++steps_ != settings_.stopAfter && !asked;
  };
}

double shareBefore(const std::vector<ClothLevel>& levels, std::size_t first, std::size_t level) {
  double done = 0, all = 0;
  for (std::size_t l = first; l < levels.size(); ++l) {
    all += levels[l].cloth.nodeCount;
    if (l < level) done += levels[l].cloth.nodeCount;
  }
  return all > 0 ? done / all : 0;
}

}  // namespace karinui
