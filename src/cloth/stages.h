#pragma once
// The two stages of a level: open seams are closed, then the cloth is relaxed to equilibrium. And the criteria of rest.
#include <functional>

#include "cloth/level_solver.h"
#include "cloth/thinner_collider.h"

namespace karinui {

inline constexpr double kFarApart = 1e9;  // metres: ties all pairs, whatever their gap

struct RestCriteria {
  double move = 0.00015;  // metres a step
  double residual = 0.4;  // node weights, rms
  double left = 0.0005;   // metres of the largest move still predicted; 0: not tested
  int calmSteps = 8;      // in a row; enough for cloth that begins to slide to show it
  int mostSteps = 400;
  bool sews = false;  // open seams are closed meanwhile; given up where they come no nearer
  // How steps are taken: the iterations of Newton's method in those that are damped or longer than 1/30 s, and the
  // cosine between successive moves above which steps become longer.
  int newton = 1;
  double creep = 0.9;
  int newtonAfter = 0;  // steps of one iteration each
};
struct StageResult {
  bool settled = false, finite = true, cancelled = false, stopped = false;
  bool falls = false;  // nothing holds the cloth
  bool torn = false;   // something pulls the cloth through what it cannot pass
  double residual = 0, left = 0;
  double seconds = 0;  // of the step that would have come next
  std::size_t steps = 0, solves = 0;
};
// Called after each step; false: stop here.
using StepWatcher = std::function<bool(int step, const LevelSolver::StepResult& result)>;

// Closes the seams without weight and friction, until all are tied or nothing comes nearer.
StageResult closeSeams(LevelSolver& solver, const Token& token, const StepWatcher& watch);
// Lets the colliders come out to their whole size under cloth that is sewn up, with friction and without weight.
StageResult growColliders(LevelSolver& solver, std::span<ThinnerCollider> colliders, const Token& token,
                          const StepWatcher& watch);
// Steps with weight and friction, until some calm steps in a row and a long step would move little. `stepsBefore`: how
// many the solver has taken towards rest already.
StageResult relax(LevelSolver& solver, Vec3 gravity, const RestCriteria& criteria, double firstSeconds,
                  const Token& token, const StepWatcher& watch, int stepsBefore = 0);

}  // namespace karinui
