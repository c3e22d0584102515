// docs/develop/howto.md, A contact: a level that pushes up what sinks into it.
#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/helpers.h"
#include "cloth/level_solver.h"

namespace karinui::test {
namespace {

class LevelContact : public Contact {
 public:
  // `area`: square metres of cloth that each node stands for.
  LevelContact(double height, double area) : height_(height), stiffness_(kContactStiffness * area) {}
  const char* name() const override { return "level"; }
  void detect(const ContactQuery& query, Workers&) override {
    sunk_.clear();
    for (NodeIndex node = 0; node < query.x.size(); ++node)
      if (const double depth = height_ - query.x[node].y; depth > 0) sunk_.push_back({node, depth});
  }
  void addGradient(std::span<Vec3> gradient) const override {
    for (const Sunk& at : sunk_) gradient[at.node] -= Vec3{0, stiffness_ * at.depth, 0};
  }
  void addHessian(ContactHessian& hessian) const override {
    for (const Sunk& at : sunk_) hessian.addAtNode(at.node, 1, {0, 1, 0}, stiffness_, 0);
  }

 private:
  struct Sunk {
    NodeIndex node = 0;
    double depth = 0;  // metres
  };
  double height_, stiffness_;
  std::vector<Sunk> sunk_;
};

// The lowest node of a square of cotton that falls from 5 cm for two seconds.
double lowestOfFallen(Contacts contacts) {
  Cloth cloth;
  addPiece(cloth, gridLattice(10, 10, 0.02), *preset("cotton"));
  const ClothState start = standingBy(cloth, [](std::size_t, Flat p) { return Vec3{p.u, 0.05, p.v}; });
  Workers workers(1);
  const NoBody nobody;
  LevelSolver solver(cloth, start.position, nobody, SettleSettings{}, 0, workers, {{}, std::move(contacts)});
  LevelSolver::StepOptions options;
  options.seconds = 1.0 / 60;
  options.mostMove = 0.02;
  options.gravity = {0, -9.81, 0};
  for (int k = 0; k < 120; ++k) solver.step(options, Token());
  double lowest = 1e9;
  for (const Vec3 p : solver.positions()) lowest = std::min(lowest, p.y);
  return lowest;
}

TEST(HowToAddAContact, ItHoldsCloth) {
  EXPECT_LT(lowestOfFallen({}), -1) << "nothing else does";
  Contacts contacts;
  contacts.push_back(std::make_unique<LevelContact>(0, 0.02 * 0.02));
  const double lowest = lowestOfFallen(std::move(contacts));
  EXPECT_GT(lowest, -1e-4);
  EXPECT_LT(lowest, 1e-4);
}

}  // namespace
}  // namespace karinui::test
