#include "karinui/geometry/patch.h"

#include <gtest/gtest.h>

#include <map>

#include "geometry/shapes.h"
#include "geometry/surfaces.h"
#include "karinui/geometry/flatten.h"

namespace karinui {
namespace {

std::vector<SurfacePath> closedLine(const SurfaceGuide& guide, const Bvh& bvh, const std::vector<Vec3>& corners) {
  std::vector<SurfacePath> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto side =
        guide.straight(surfaces::nearest(bvh, corners[i]), surfaces::nearest(bvh, corners[(i + 1) % corners.size()]));
    EXPECT_TRUE(side);
    sides.push_back(*side);
  }
  return sides;
}

// A disk: every inner edge has two faces that run it both ways, the border is what is left, in order.
void expectDisk(const Patch& patch) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
  for (const Triangle& t : patch.mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++runs[{t[k], t[(k + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : runs) {
    EXPECT_EQ(count, 1);
    if (!runs.count({edge.second, edge.first})) ++open;
  }
  EXPECT_EQ(open, patch.border.size());
  for (std::size_t i = 0; i < patch.border.size(); ++i)
    EXPECT_TRUE(runs.count({patch.border[i], patch.border[(i + 1) % patch.border.size()]}));
  EXPECT_EQ(patch.mesh.points.size() + patch.mesh.faces.size(), runs.size() - (runs.size() - open) / 2 + 1);
}

TEST(Patch, OfAPlaneHasTheAreaOfItsPolygon) {
  const TriangleMesh mesh = surfaces::plane(23, 1.0);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const std::vector<Vec3> corners{{0.1, 0.12, 0}, {0.83, 0.2, 0}, {0.7, 0.9, 0}, {0.4, 0.5, 0}, {0.15, 0.8, 0}};
  const auto patch = cutPatch(guide, closedLine(guide, bvh, corners));
  ASSERT_TRUE(patch);
  expectDisk(*patch);
  EXPECT_FALSE(patch->turned);
  double area = 0, border = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % corners.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
    border += distance(a, b);
    EXPECT_NEAR(patch->sideLength(static_cast<std::uint32_t>(i)), distance(a, b), 1e-9);
    EXPECT_LT(distance(patch->mesh.points[patch->border[patch->first[i]]], a), 1e-9);
  }
  EXPECT_NEAR(patch->area(), area, 1e-9);
  EXPECT_NEAR(patch->borderLength(), border, 1e-9);
}

TEST(Patch, DrawnClockwiseIsTheSamePatchTurned) {
  const TriangleMesh mesh = surfaces::plane(23, 1.0);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch = cutPatch(guide, closedLine(guide, bvh, {{0.1, 0.12, 0}, {0.15, 0.8, 0}, {0.83, 0.2, 0}}),
                              surfaces::nearest(bvh, {0.2, 0.3, 0}));
  ASSERT_TRUE(patch);
  expectDisk(*patch);
  EXPECT_TRUE(patch->turned);
  EXPECT_NEAR(patch->sideLength(0), std::hypot(0.05, 0.68), 1e-9);
}

TEST(Patch, AlongCornersAndEdgesOfTheMesh) {
  const TriangleMesh mesh = surfaces::plane(10, 1.0);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch =
      cutPatch(guide, closedLine(guide, bvh, {{0.2, 0.2, 0}, {0.8, 0.2, 0}, {0.8, 0.8, 0}, {0.2, 0.8, 0}}));
  ASSERT_TRUE(patch);
  expectDisk(*patch);
  EXPECT_NEAR(patch->area(), 0.36, 1e-12);
}

TEST(Patch, HoldsTheGivenPlace) {
  const TriangleMesh mesh = surfaces::ball(60, 30, 0.2);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const std::vector<Vec3> corners{{0.1, 0.05, 0.16}, {-0.1, 0.05, 0.16}, {-0.1, -0.08, 0.16}, {0.1, -0.08, 0.16}};
  const auto small = cutPatch(guide, closedLine(guide, bvh, corners));
  ASSERT_TRUE(small);
  expectDisk(*small);
  EXPECT_LT(small->area(), 0.05);
  const auto bag = cutPatch(guide, closedLine(guide, bvh, corners), surfaces::nearest(bvh, {0, 0, -0.2}));
  ASSERT_FALSE(bag);
  EXPECT_NE(text(bag.error().what).find("bag"), std::string::npos);
}

TEST(Patch, ALineRoundALimbIsRefused) {
  const TriangleMesh mesh = surfaces::ball(60, 60, 0.2);
  TriangleMesh limb = mesh;
  for (Vec3& p : limb.points) p.y *= 4;
  const Bvh bvh(limb);
  const SurfaceGuide guide(limb);
  const auto patch = cutPatch(guide, closedLine(guide, bvh, {{0, 0, 0.2}, {0.2, 0, 0}, {0, 0, -0.2}, {-0.2, 0, 0}}));
  ASSERT_FALSE(patch);
  EXPECT_NE(text(patch.error().what).find("round the body"), std::string::npos);
}

TEST(Patch, ATubeSlitOpenAlongASeamIsASheet) {
  const TriangleMesh mesh = surfaces::cylinder(80, 40, 0.05, 0.5);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto on = [](double a, double y) { return Vec3{0.05 * std::sin(a), y, 0.05 * std::cos(a)}; };
  // Round the top against the clock, down the seam, round the bottom, up the seam again.
  const auto patch = cutPatch(guide,
                              closedLine(guide, bvh,
                                         {on(0, 0.41), on(-2, 0.41), on(-4, 0.41), on(0, 0.41), on(0, 0.09),
                                          on(2, 0.09), on(4, 0.09), on(0, 0.09)}),
                              surfaces::nearest(bvh, on(3, 0.2)));
  ASSERT_TRUE(patch) << text(patch.error().what);
  expectDisk(*patch);
  EXPECT_NEAR(patch->area(), 2 * std::numbers::pi * 0.05 * 0.32, 2e-4);
  EXPECT_NEAR(patch->sideLength(3), 0.32, 1e-6);
  EXPECT_NEAR(patch->sideLength(7), 0.32, 1e-6);
}

TEST(Patch, ACrossingLineIsRefusedSayingWhere) {
  const TriangleMesh mesh = surfaces::plane(23, 1.0);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch =
      cutPatch(guide, closedLine(guide, bvh, {{0.1, 0.1, 0}, {0.9, 0.83, 0}, {0.9, 0.1, 0}, {0.1, 0.9, 0}}));
  ASSERT_FALSE(patch);
  EXPECT_EQ(text(patch.error().what.values[0]), "1");
  EXPECT_EQ(text(patch.error().what.values[1]), "3");
}

TEST(Patch, ACrossingAtACornerOfTheMeshIsRefused) {
  const TriangleMesh mesh = surfaces::plane(10, 1.0);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch =
      cutPatch(guide, closedLine(guide, bvh, {{0.1, 0.1, 0}, {0.9, 0.9, 0}, {0.9, 0.1, 0}, {0.1, 0.9, 0}}));
  ASSERT_FALSE(patch);
  EXPECT_NE(text(patch.error().what).find("crosses itself"), std::string::npos);
}

TEST(Patch, AHoleInsideIsRefused) {
  TriangleMesh mesh = surfaces::plane(20, 1.0);
  mesh.faces.erase(mesh.faces.begin() + 410);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch =
      cutPatch(guide, closedLine(guide, bvh, {{0.1, 0.12, 0}, {0.83, 0.2, 0}, {0.7, 0.9, 0}, {0.15, 0.8, 0}}));
  ASSERT_FALSE(patch);
  EXPECT_NE(text(patch.error().what).find("hole"), std::string::npos);
}

TEST(Patch, RemeshedKeepsBorderAndAreaWithGoodTriangles) {
  const TriangleMesh mesh = surfaces::ball(90, 45, 0.2);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto patch = cutPatch(
      guide, closedLine(guide, bvh, {{0.1, 0.05, 0.16}, {-0.1, 0.05, 0.16}, {-0.1, -0.08, 0.16}, {0.1, -0.08, 0.16}}));
  ASSERT_TRUE(patch);
  const auto flat = unfold(patch->mesh, patch->border, Token());
  ASSERT_TRUE(flat);
  const auto made = remeshed(*patch, *flat, 0.01);
  ASSERT_TRUE(made) << text(made.error().what);
  expectDisk(made->patch);
  EXPECT_NEAR(made->patch.area(), patch->area(), 0.01 * patch->area());
  double thinnest = 180;
  for (const Triangle& t : made->patch.mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = made->patch.mesh.points;
      const Vec3 a = p[t[(k + 1) % 3]] - p[t[k]], b = p[t[(k + 2) % 3]] - p[t[k]];
      thinnest = std::fmin(thinnest, std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi);
    }
  EXPECT_GT(thinnest, 15);

  Patch lifted = made->patch;
  LiftSettings lift;
  lift.ease = 0.008;
  liftOff(lifted, mesh, bvh, lift);
  for (Vec3 p : lifted.mesh.points) {
    EXPECT_GT(length(p), 0.2 + 0.008 - 0.0005);
    EXPECT_LT(length(p), 0.2 + 0.008 + 0.002);
  }
}

// A star drawn on a plane or a ball, and the same cut in two by a line over it: areas add up, and the cut is the border
// of both.
TEST(Patch, AreasAddUpWhereItIsCutInTwo) {
  for (const bool round : {false, true}) {
    const TriangleMesh mesh = round ? surfaces::ball(80, 40, 0.2) : surfaces::plane(31, 1.0);
    const Bvh bvh(mesh);
    const SurfaceGuide guide(mesh);
    for (unsigned seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE((round ? "ball, seed " : "plane, seed ") + std::to_string(seed));
      test::Numbers numbers(seed);
      std::vector<Vec3> corners;
      const int count = 5 + static_cast<int>(numbers.below(4));
      for (int n = 0; n < count; ++n) {
        const double a = 2 * std::numbers::pi * n / count + 0.1, r = numbers.between(0.6, 1);
        corners.push_back(round ? normalized(Vec3{0.5 * r * std::cos(a), 0.5 * r * std::sin(a), 1}) * 0.2
                                : Vec3{0.5 + 0.4 * r * std::cos(a), 0.5 + 0.4 * r * std::sin(a), 0});
      }
      // The middle sees every corner: a line from corner to corner over it stays inside.
      const Vec3 middle = round ? Vec3{0, 0, 0.2} : Vec3{0.5, 0.5, 0};
      const auto j = corners.begin() + count / 2;
      std::vector<Vec3> one(corners.begin(), j + 1), other(j, corners.end());
      one.push_back(middle), other.push_back(corners.front()), other.push_back(middle);
      const auto whole = cutPatch(guide, closedLine(guide, bvh, corners)),
                 first = cutPatch(guide, closedLine(guide, bvh, one)),
                 second = cutPatch(guide, closedLine(guide, bvh, other));
      ASSERT_TRUE(whole && first && second);
      for (const auto* patch : {&*whole, &*first, &*second}) expectDisk(*patch);
      EXPECT_NEAR(first->area() + second->area(), whole->area(), 1e-9);
      const auto cut = guide.straight(surfaces::nearest(bvh, corners.front()), surfaces::nearest(bvh, middle)),
                 rest = guide.straight(surfaces::nearest(bvh, middle), surfaces::nearest(bvh, *j));
      EXPECT_NEAR(first->borderLength() + second->borderLength(),
                  whole->borderLength() + 2 * (cut->length + rest->length), 1e-9);
    }
  }
}

}  // namespace
}  // namespace karinui
