#include "bench/run.h"

#include <cmath>

namespace karinui::bench {
namespace {

// The least distance of 15 places of each face.
double clearanceOf(const Cloth& cloth, const ClothState& state, const Collider& body) {
  double least = 1e9;
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& face : piece.lattice->faces)
      for (int a = 0; a <= 4; ++a)
        for (int b = 0; a + b <= 4; ++b) {
          const Vec3 place = state.position[piece.firstNode + face[0]] * (a / 4.0) +
                             state.position[piece.firstNode + face[1]] * (b / 4.0) +
                             state.position[piece.firstNode + face[2]] * ((4 - a - b) / 4.0);
          least = std::fmin(least, body.exactSample(place).distance);
        }
  return least;
}

}  // namespace

Examined examine(const Workload& load) {
  const ClothLevel& finest = load.levels.back();
  Examined so{check(finest.cloth, finest.state, load.body.get())};
  if (!so.check.finite) return so;
  so.clearance = clearanceOf(finest.cloth, finest.state, *load.collider);
  so.check.penetration = std::fmax(so.check.penetration, -so.clearance);
  return so;
}

Result<Finding> run(Workload& load, const Token& token, Workers& workers, bool continued) {
  Finding finding;
  SettleSettings settings;
  settings.continueAfterRest = continued;
  const auto report = settle(load.levels, *load.collider, settings, token, workers);
  if (!report) return report.error();
  finding.report = *report;
  finding.found = examine(load);
  const auto after = runDynamics(load.levels.back(), *load.collider, {}, kDynamicsFrames, token, workers);
  if (!after) return after.error();
  finding.after = *after;
  return finding;
}

}  // namespace karinui::bench
