#include "cloth/intersection_contour.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "cloth/helpers.h"
#include "cloth/intersection_removal.h"
#include "karinui/geometry/triangle_intersection.h"

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

// What holds still cannot be drawn apart: on a coarse level a frozen collar goes through its stand.
TEST(IntersectionContour, SheetsThatBothHoldStillAreLeft) {
  Workers workers(1);
  for (const bool first : {true, false})
    for (const bool second : {true, false}) {
      CrossedSheets s = sheets(0.011);
      s.cloth.pieces[0].live = first;
      s.cloth.pieces[1].live = second;
      IntersectionContour contour(s.cloth);
      contour.find(s.state.position, workers);
      EXPECT_EQ(contour.crossings() > 0, first || second);
    }
}

// Each edge against each face by the exact predicate.
std::size_t crossingsOneByOne(const Cloth& cloth, const std::vector<Vec3>& x) {
  std::vector<Triangle> faces;
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces)
      faces.push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
  std::set<std::tuple<NodeIndex, NodeIndex, std::size_t>> found;
  for (const Triangle& f : faces)
    for (std::size_t g = 0; g < faces.size(); ++g) {
      if (std::any_of(f.begin(), f.end(),
                      [&](NodeIndex k) { return std::find(faces[g].begin(), faces[g].end(), k) != faces[g].end(); }))
        continue;
      const std::array<NanoPoint, 3> corners{toNano(x[faces[g][0]]), toNano(x[faces[g][1]]), toNano(x[faces[g][2]])};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(f[c], f[(c + 1) % 3]);
        if (segmentCrossesTriangle(toNano(x[low]), toNano(x[high]), corners)) found.emplace(low, high, g);
      }
    }
  return found.size();
}

// Two sheets that lie on each other within micrometres to centimetres, some drawn together so that faces are slivers.
TEST(IntersectionContour, FindsWhatTheExactPredicateFinds) {
  Workers workers(1);
  std::mt19937 random(7);
  std::size_t all = 0;
  for (const double rough : {2e-8, 1e-6, 1e-4, 5e-3, 2e-2})
    for (const double narrow : {1.0, 1e-2, 1e-5}) {
      CrossedSheets s = sheets(0);
      std::normal_distribution<double> off(0, rough);
      for (std::size_t piece = 0, n = 0; piece < 2; ++piece)
        for (const Flat p : s.cloth.pieces[piece].lattice->nodes)
          s.state.position[n++] =
              Vec3{p.u + off(random), off(random), (p.v + off(random)) * narrow + 0.003 * static_cast<double>(piece)};
      IntersectionContour contour(s.cloth);
      contour.find(s.state.position, workers);
      EXPECT_EQ(contour.crossings(), crossingsOneByOne(s.cloth, s.state.position)) << rough << ", " << narrow;
      all += contour.crossings();
    }
  EXPECT_GT(all, 1000u);
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
