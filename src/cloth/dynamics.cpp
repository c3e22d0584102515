#include "karinui/cloth/dynamics.h"

#include <cmath>

#include "cloth/finish.h"
#include "cloth/input_check.h"

namespace karinui {
namespace {

Vec3 centreOf(const LevelSolver& solver) {
  Vec3 sum;
  for (NodeIndex k : solver.moving()) sum += solver.positions()[k];
  return sum * (1.0 / static_cast<double>(std::max<std::size_t>(1, solver.moving().size())));
}

}  // namespace

Result<DynamicsReport> runDynamics(const ClothLevel& level, const ColliderList& colliders,
                                   const SettleSettings& settings, int frames, const Token& token, Workers& workers) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  LevelSolver solver(level.cloth, level.state.position, colliders, settings,
                     settings.clothOnCloth ? clothRadius(level.cloth, level.cloth.spacing) : 0, workers);
  solver.tieWithin(level.cloth.spacing);
  LevelSolver::StepOptions options;
  options.seconds = 1.0 / 60;
  options.mostMove = 1e9;
  options.gravity = settings.gravity;
  options.stopping = {40, 150, 0.02};
  DynamicsReport report;
  const Vec3 before = centreOf(solver);
  for (int frame = 0; frame < frames; ++frame) {
    const auto step = solver.step(options, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
    const double speed = step.move / options.seconds;
    report.topSpeed = std::fmax(report.topSpeed, speed);
    if (frame < 10) report.firstTopSpeed = report.topSpeed;
  }
  report.drift = distance(centreOf(solver), before);
  return report;
}

}  // namespace karinui
