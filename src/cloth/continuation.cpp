#include "cloth/continuation.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kStricter = 50;  // times smaller limits
constexpr int kLeastMore = 500;   // steps,
constexpr int kTimesMore = 5;     // or so many times those to rest

double percentile(const std::vector<double>& sorted, std::size_t percent) {
  return sorted[std::min(sorted.size() - 1, sorted.size() * percent / 100)];
}

}  // namespace

StepWatcher EnergyTrace::watching(StepWatcher watch) {
  return [this, watch = std::move(watch)](int step, const LevelSolver::StepResult& result) {
    EnergySample sample = samples_.empty() ? EnergySample{} : samples_.back();
    ++sample.steps;
    sample.solves += static_cast<std::size_t>(result.iterations);
    sample.cpuSeconds = spent_.cpuSeconds();
    sample.joules = solver_.potentialEnergy(gravity_);
    samples_.push_back(sample);
    return !watch || watch(step, result);
  };
}

std::optional<Continuation> continueFromRest(LevelSolver& solver, Vec3 gravity, RestCriteria criteria,
                                             const StageResult& rest, const Token& token, const StepWatcher& watch) {
  const std::vector<Vec3> called = solver.positions();
  const int before = static_cast<int>(rest.steps);
  criteria.move /= kStricter;
  criteria.left /= kStricter;
  criteria.mostSteps = std::max(kLeastMore, kTimesMore * before);
  const StageResult end = relax(solver, gravity, criteria, rest.seconds, token, watch, before);
  if (end.cancelled || !end.finite) return std::nullopt;
  Continuation continuation{end.settled, end.steps, end.solves};
  std::vector<double> far;
  for (NodeIndex k : solver.moving()) far.push_back(distance(solver.positions()[k], called[k]));
  solver.setPositions(called);
  if (far.empty()) return continuation;
  std::sort(far.begin(), far.end());
  double squares = 0;
  for (double d : far) squares += d * d;
  continuation.max = far.back();
  continuation.p99 = percentile(far, 99);
  continuation.p95 = percentile(far, 95);
  continuation.rms = std::sqrt(squares / static_cast<double>(far.size()));
  return continuation;
}

}  // namespace karinui
