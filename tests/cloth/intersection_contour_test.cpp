#include "cloth/intersection_contour.h"

#include <gtest/gtest.h>

#include <numeric>

#include "cloth/helpers.h"
#include "cloth/intersection_removal.h"

namespace karinui::test {
namespace {

// Two sheets; the second stands upright on a corner, which is `below` the first.
struct CrossedSheets {
  Cloth cloth;
  ClothState state;
};
CrossedSheets sheets(double below) {
  CrossedSheets s;
  addPiece(s.cloth, gridLattice(8, 8, 0.02), *preset("cotton"));
  addPiece(s.cloth, gridLattice(8, 8, 0.02), *preset("cotton"));
  s.state = standingBy(s.cloth, [&](std::size_t piece, Flat p) {
    return piece == 0 ? Vec3{p.u, 0, p.v} : Vec3{0.7 * (p.u - p.v) + 0.073, 0.7 * (p.u + p.v) - below, 0.071};
  });
  return s;
}

TEST(IntersectionContour, SheetsApartAreNotCrossed) {
  const CrossedSheets s = sheets(-0.001);
  IntersectionContour contour(s.cloth);
  Workers workers(1);
  contour.find(s.state.position, workers);
  EXPECT_EQ(contour.crossings(), 0u);
  for (Vec3 way : contour.direction()) EXPECT_EQ(squaredLength(way), 0);
}

TEST(IntersectionContour, TheWayOutDrawsThePassedCornerBack) {
  CrossedSheets s = sheets(0.011);
  IntersectionContour contour(s.cloth);
  Workers workers(1);
  contour.find(s.state.position, workers);
  ASSERT_GT(contour.crossings(), 0u);
  for (int k = 0; k < 60 && contour.crossings() > 0; ++k) {
    for (std::size_t n = 0; n < s.state.position.size(); ++n) {
      EXPECT_LE(length(contour.direction()[n]), 1 + 1e-12);
      EXPECT_TRUE(contour.near()[n] || squaredLength(contour.direction()[n]) == 0);
      s.state.position[n] += contour.direction()[n] * 0.002;
    }
    contour.find(s.state.position, workers);
  }
  EXPECT_EQ(contour.crossings(), 0u);
}

// Something presses the sheets together, so that they do not move: what separates them grows until it is given up.
TEST(IntersectionRemoval, PushesHarderWhileNothingGivesWay) {
  const CrossedSheets s = sheets(0.011);
  std::vector<NodeIndex> moving(s.cloth.nodeCount);
  std::iota(moving.begin(), moving.end(), 0);
  SelfContact self(s.cloth, 0.002);
  IntersectionRemoval removal(s.cloth, moving, self);
  Workers workers(1);
  ASSERT_TRUE(removal.start(s.state.position, workers));
  const auto force = [&] {
    std::vector<Vec3> gradient(s.cloth.nodeCount);
    removal.addGradient(gradient);
    double most = 0;
    for (const Vec3 g : gradient) most = std::fmax(most, length(g));
    return most;
  };
  const double first = force();
  EXPECT_GT(first, 0);
  int steps = 0;
  double last = first;
  for (; removal.active() && steps < 200; ++steps) {
    const double now = force();
    EXPECT_GE(now, last);
    last = now;
    removal.afterStep(s.state.position, false, workers);
  }
  EXPECT_GT(last, 20 * first);
  EXPECT_LT(last, 100 * first);
  EXPECT_LT(steps, 100);
  EXPECT_EQ(force(), 0) << "given up";
}

}  // namespace
}  // namespace karinui::test
