#include "cloth/intersection_contour.h"

#include <gtest/gtest.h>

#include "cloth/helpers.h"

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

}  // namespace
}  // namespace karinui::test
