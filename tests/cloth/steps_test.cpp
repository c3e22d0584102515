// What a step of the solver may do to the energy of cloth that touches nothing.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/lattice_areas.h"
#include "cloth/level_solver.h"

namespace karinui::test {
namespace {

// A steep fall out of the level overshoots for some steps, as each takes the springs to be as they were when it began;
// from then on nothing is ever gained: height, stretch, bend and motion together only fall.
TEST(Steps, NeverGainEnergyOnceTheFirstFallIsOver) {
  for (const char* name : {"cotton", "chiffon", "denim"}) {
    SCOPED_TRACE(name);
    const Fabric fabric = *preset(name);
    Cloth cloth;
    addPiece(cloth, gridLattice(20, 20, 0.05), fabric);
    cloth.pinned = {0, 20};
    const ClothState start = standingBy(cloth, [](std::size_t, Flat p) { return Vec3{p.u, 1, p.v}; });
    Workers workers(1);
    const NoBody nobody;
    SettleSettings settings;
    LevelSolver solver(cloth, start.position, nobody, settings, 0, workers);
    const LatticeAreas areas = latticeAreas(*cloth.pieces[0].lattice);
    LevelSolver::StepOptions options;
    options.seconds = 1.0 / 30;
    options.mostMove = 0.05;
    options.gravity = {0, -9.81, 0};
    double before = 0;
    std::vector<Vec3> last = solver.positions();
    for (int k = 0; k < 200; ++k) {
      solver.step(options, Token());
      const std::vector<Vec3>& x = solver.positions();
      double energy = solver.potentialEnergy(options.gravity);
      for (std::size_t n = 0; n < x.size(); ++n) {
        const double mass = fabric.weight * (areas.cell[n] + areas.ring[n]);
        energy += 0.5 * mass * squaredLength(x[n] - last[n]) / (options.seconds * options.seconds);
      }
      if (k > 15) {
        ASSERT_LE(energy, before + 1e-12) << "step " << k;
      }
      before = energy;
      last = x;
    }
  }
}

}  // namespace
}  // namespace karinui::test
