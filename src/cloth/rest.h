#pragma once
// The stages a level goes through on its way to rest, and what is asked before calling it rest.
#include <functional>

#include "cloth/level_solver.h"

namespace karinui {

inline constexpr double kFarApart = 1e9;  // metres: ties whatever the gap

struct RestRule {
  double move = 0.00015;  // metres a step
  double residual = 0.4;  // node weights, rms
  double left = 0.0005;   // metres of the largest move still predicted; 0: not asked
  int calmSteps = 8;      // in a row; enough for cloth that only begins to slide to show it
  int mostSteps = 400;
  bool sews = false;  // open seams are drawn together meanwhile, ever firmer, and given up where they come no nearer
};
struct RestOutcome {
  bool settled = false, finite = true, cancelled = false, falls = false, stopped = false;
  double residual = 0, left = 0;
  std::size_t steps = 0, solves = 0;
};
// Called after each step; false: stop here.
using StepWatcher = std::function<bool(int step, const LevelSolver::Outcome& outcome)>;

// Seams are drawn together: no weight, no friction, until all are tied or nothing moves on.
RestOutcome sew(LevelSolver& solver, const Token& token, const StepWatcher& watch);
// Weight and friction, until some calm steps in a row and little left to move.
RestOutcome rest(LevelSolver& solver, Vec3 gravity, const RestRule& rule, double firstSeconds, const Token& token,
                 const StepWatcher& watch);

}  // namespace karinui
