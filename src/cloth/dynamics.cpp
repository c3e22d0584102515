#include "karinui/cloth/dynamics.h"

#include <cmath>

#include "cloth/job.h"

namespace karinui {
namespace {

Vec3 centreOf(const LevelSolver& solver) {
  Vec3 sum;
  for (NodeIndex k : solver.moving()) sum += solver.places()[k];
  return sum * (1.0 / static_cast<double>(std::max<std::size_t>(1, solver.moving().size())));
}

}  // namespace

Result<DynamicsReport> runDynamics(const ClothLevel& level, const ColliderList& colliders,
                                   const SettleSettings& settings, int frames, const Token& token, Workers& workers) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  LevelSolver solver(level.cloth, level.state.position, colliders, settings,
                     settings.clothOnCloth ? clothRadius(level.cloth.spacing, level.cloth.spacing) : 0, workers);
  solver.tieWithin(level.cloth.spacing);
  LevelSolver::Stride stride;
  stride.seconds = 1.0 / 60;
  stride.mostMove = 1e9;
  stride.gravity = settings.gravity;
  stride.stop = {40, 150, 0.02};
  DynamicsReport so;
  const Vec3 before = centreOf(solver);
  for (int frame = 0; frame < frames; ++frame) {
    const auto step = solver.step(stride, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
    const double speed = step.move / stride.seconds;
    so.topSpeed = std::fmax(so.topSpeed, speed);
    if (frame < 10) so.firstTopSpeed = so.topSpeed;
  }
  so.drift = distance(centreOf(solver), before);
  return so;
}

}  // namespace karinui
