// docs/develop/howto.md, An energy: soft threads that tie nodes of the cloth to places in the room.
#include <gtest/gtest.h>

#include "cloth/helpers.h"
#include "cloth/lattice_areas.h"
#include "cloth/level_solver.h"

namespace karinui::test {
namespace {

// Value k/2 |x - place|^2 for each thread. An element has one node.
class Threads : public ElementEnergy<Threads, 1> {
 public:
  struct Thread {
    NodeIndex node = 0;
    Vec3 place;
    double stiffness = 0;  // N/m
  };
  Threads(std::vector<Thread> threads, std::size_t nodeCount) : threads_(std::move(threads)) {
    std::vector<std::array<NodeIndex, 1>> nodes;
    for (const Thread& thread : threads_) nodes.push_back({thread.node});
    setElements(std::move(nodes), nodeCount);
  }
  double elementValue(std::size_t e, const Corners& x) const {
    return 0.5 * threads_[e].stiffness * squaredLength(x[0] - threads_[e].place);
  }
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 1> out) const {
    out[0] = (x[0] - threads_[e].place) * threads_[e].stiffness;
  }
  void elementBlocks(std::size_t e, const Corners&, std::span<Block3> out) const {
    out[0] = {};
    addIdentityAndOuter(out[0], threads_[e].stiffness, 0, {});
  }

 private:
  std::vector<Thread> threads_;
};

constexpr std::uint32_t kCells = 10;
constexpr double kSpacing = 0.02;

// A square of cotton, hung by two corners on threads whose upper ends are where the corners are at first.
struct Hung {
  Cloth cloth;
  ClothState start;
  std::vector<Threads::Thread> threads;
  double weight = 0;  // newtons
  Hung() {
    const Fabric fabric = *preset("cotton");
    addPiece(cloth, gridLattice(kCells, kCells, kSpacing), fabric);
    start = standingBy(cloth, [](std::size_t, Flat p) { return Vec3{p.u, p.v, 0}; });
    for (const NodeIndex corner : {kCells * (kCells + 1), kCells * (kCells + 2)})
      threads.push_back({corner, start.position[corner], 20});
    const LatticeAreas areas = latticeAreas(*cloth.pieces[0].lattice);
    for (std::size_t k = 0; k < areas.cell.size(); ++k)
      weight += (areas.cell[k] + areas.ring[k]) * fabric.weight * 9.81;
  }
};

TEST(HowToAddAnEnergy, TheSolverBringsClothToRestOnIt) {
  Hung hung;
  Workers workers(1);
  const NoBody nobody;
  AddedTerms added;
  added.energies.push_back(std::make_unique<Threads>(hung.threads, hung.cloth.nodeCount));
  LevelSolver solver(hung.cloth, hung.start.position, nobody, SettleSettings{}, 0, workers, std::move(added));
  LevelSolver::StepOptions options;
  options.seconds = 1.0 / 30;
  options.mostMove = kSpacing;
  options.velocityKept = 0.5;
  options.gravity = {0, -9.81, 0};
  for (int k = 0; k < 300; ++k) solver.step(options, Token());
  Vec3 pull;
  for (const auto& thread : hung.threads) pull += (thread.place - solver.positions()[thread.node]) * thread.stiffness;
  EXPECT_NEAR(pull.y, hung.weight, 1e-3 * hung.weight) << "the threads carry the cloth, no more and no less";
}

TEST(HowToAddAnEnergy, ItsGradientIsTheSlopeOfItsValue) {
  Hung hung;
  Workers workers(1);
  const Threads energy(hung.threads, hung.cloth.nodeCount);
  std::vector<Vec3> x = hung.start.position, gradient(x.size());
  for (Vec3& p : x) p += {0.01, -0.02, 0.03};
  energy.addGradient(x, gradient, workers);
  const NodeIndex node = hung.threads[0].node;
  const double step = 1e-6;
  x[node].y += step;
  const double up = energy.value(x, workers);
  x[node].y -= 2 * step;
  EXPECT_NEAR(gradient[node].y, (up - energy.value(x, workers)) / (2 * step), 1e-6);
}

}  // namespace
}  // namespace karinui::test
