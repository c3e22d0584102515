#pragma once
// Measures rest itself: the energy on the way there, and how far the place called rest is from where the same solver
// stands after many more steps.
#include <optional>
#include <vector>

#include "cloth/finish.h"

namespace karinui {

// A sample after each step. The solver and the clock must outlive it.
class EnergyTrace {
 public:
  EnergyTrace(LevelSolver& solver, Vec3 gravity, const ResourceUse& spent)
      : solver_(solver), gravity_(gravity), spent_(spent) {}
  StepWatcher watching(StepWatcher watch);  // the watcher that samples, then asks the other
  std::vector<EnergySample> take() { return std::move(samples_); }

 private:
  LevelSolver& solver_;
  Vec3 gravity_;
  const ResourceUse& spent_;
  std::vector<EnergySample> samples_;
};

// Goes on from the rest that `relax` with these criteria called. The solver stands there again afterwards. Nothing
// where it was cancelled or is no longer finite.
std::optional<Continuation> continueFromRest(LevelSolver& solver, Vec3 gravity, RestCriteria criteria,
                                             const StageResult& rest, const Token& token, const StepWatcher& watch);

}  // namespace karinui
