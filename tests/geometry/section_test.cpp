#include "karinui/geometry/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "geometry/shapes.h"
#include "karinui/geometry/cut_mesh.h"

namespace karinui {
namespace {

using test::append;
using test::ball;
using test::box;
using test::Numbers;

TEST(Section, OfABallIsACircleWithTheSolidOnTheLeft) {
  const TriangleMesh m = ball({1, 2, 3}, 0.5, 6);
  Numbers numbers(4);
  for (int n = 0; n < 20; ++n) {
    const Vec3 normal = normalized(numbers.point(1));
    const double height = numbers.between(-0.4, 0.4);
    const auto loops = section(m, {Vec3{1, 2, 3} + normal * height, normal});
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_TRUE(loops[0].closed);
    EXPECT_EQ(loops[0].faces.size(), loops[0].points.size());
    const double r = std::sqrt(0.25 - height * height);
    EXPECT_NEAR(lineLength(loops[0].points, true), 2 * std::numbers::pi * r, 4e-3);
    EXPECT_NEAR(enclosedArea(loops[0].points, normal), std::numbers::pi * r * r, 2e-3);
    EXPECT_NEAR(tightTapeLength(loops[0].points, normal), lineLength(loops[0].points, true), 1e-4);
  }
}

TEST(Section, OfAHollowBallRunsBackwardsInside) {
  TriangleMesh m = ball({}, 1, 4), hollow = ball({}, 0.5, 4);
  for (Triangle& f : hollow.faces) std::swap(f[0], f[1]);
  append(m, hollow);
  const auto loops = section(m, {{0, 0.1, 0}, {0, 1, 0}});
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_GT(enclosedArea(loops[0].points, {0, 1, 0}), 0);
  EXPECT_LT(enclosedArea(loops[1].points, {0, 1, 0}), 0);
}

TEST(Section, ThroughCornersAndFacesStaysClosed) {
  // Every height of a corner of this ball and both faces of the box lie exactly in the plane.
  const TriangleMesh m = ball({}, 1, 3);
  for (const Vec3& p : m.points)
    for (const SectionLoop& loop : section(m, {p, {0, 1, 0}})) EXPECT_TRUE(loop.closed);
  const auto equator = section(m, {{}, {0, 1, 0}});
  ASSERT_EQ(equator.size(), 1u);
  EXPECT_NEAR(tightTapeLength(equator[0].points, {0, 1, 0}), 2 * std::numbers::pi, 0.02);
  const TriangleMesh b = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(section(b, {{0, 1, 0}, {0, 1, 0}}).size(), 1u);
  EXPECT_TRUE(section(b, {{0, 0, 0}, {0, 1, 0}}).empty());
  EXPECT_TRUE(section(b, {{0, 2, 0}, {0, 1, 0}}).empty());
}

TEST(CutMesh, AHalfBallIsClosedAndHalfAsLarge) {
  const TriangleMesh solid = ball({0, 0, 0}, 1, 4);
  const double whole = volume(solid);
  for (const Vec3 normal : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, normalized(Vec3{1, 2, -0.5})}) {
    const Plane plane{{0.001, 0.002, 0.0005}, normal};
    const CutMesh cut = cutOff(solid, plane, true);
    EXPECT_NEAR(volume(cut.mesh), whole / 2, 0.02 * whole) << "a lid that faced inward would not add up";
    EXPECT_GT(cut.closing, 3u);
    for (const Triangle& face : cut.mesh.faces)
      for (const std::uint32_t p : face) EXPECT_LE(dot(cut.mesh.points[p] - plane.through, normal), 1e-9);
    ASSERT_EQ(cut.points.size(), cut.mesh.points.size());
    for (std::size_t i = 0; i < cut.points.size(); ++i)
      EXPECT_NEAR(distance(cut.mesh.points[i],
                           lerp(solid.points[cut.points[i].from], solid.points[cut.points[i].to], cut.points[i].share)),
                  0, 1e-12);
  }
  EXPECT_EQ(cutOff(solid, {{0, 9, 0}, {0, 1, 0}}, true).mesh.faces.size(), solid.faces.size());
  EXPECT_TRUE(cutOff(solid, {{0, -9, 0}, {0, 1, 0}}, true).mesh.faces.empty());
}

TEST(CutMesh, OnlyThePartNearThePlaneGoes) {
  TriangleMesh two = ball({0, 0, 0}, 1, 4);
  const auto more = static_cast<std::uint32_t>(two.points.size());
  const std::size_t faces = two.faces.size();
  for (std::uint32_t i = 0; i < more; ++i) two.points.push_back(two.points[i] + Vec3{10, 0, 0});
  for (std::size_t f = 0; f < faces; ++f)
    two.faces.push_back({two.faces[f][0] + more, two.faces[f][1] + more, two.faces[f][2] + more});
  const Plane plane{{0, 0.01, 0}, {0, 1, 0}};
  const std::vector<bool> part = partAbove(two, plane, 3);
  EXPECT_EQ(std::count(part.begin() + static_cast<std::ptrdiff_t>(faces), part.end(), true), 0) << "the other ball";
  const double whole = volume(two);
  EXPECT_NEAR(volume(cutOff(two, plane, true, &part).mesh), 0.75 * whole, 0.02 * whole);
}

TEST(Section, OfAnOpenMeshIsOpen) {
  TriangleMesh m = box({0, 0, 0}, {1, 1, 1});
  m.faces.erase(m.faces.begin() + 8, m.faces.begin() + 10);  // without its x = 0 side
  const auto loops = section(m, {{0, 0.5, 0}, {0, 1, 0}});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_FALSE(loops[0].closed);
  EXPECT_NEAR(lineLength(loops[0].points, false), 3, 1e-12);
}

TEST(Hull, HoldsEveryPointAndTurnsLeft) {
  Numbers numbers(8);
  for (int n = 0; n < 50; ++n) {
    std::vector<Flat> points;
    for (int i = 0; i < 200; ++i)
      points.push_back({std::round(numbers.between(-9, 9)), std::round(numbers.between(-9, 9))});
    const auto hull = convexHull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Flat a = hull[i], b = hull[(i + 1) % hull.size()], c = hull[(i + 2) % hull.size()];
      EXPECT_GT(cross(b - a, c - b), 0);
      for (const Flat& p : points) EXPECT_GE(cross(b - a, p - a), 0);
    }
  }
}

TEST(Hull, OfFewOrEqualPoints) {
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull(std::vector<Flat>(5, Flat{1, 1})).size(), 1u);
  EXPECT_EQ(convexHull(std::vector<Flat>{{0, 0}, {1, 1}, {2, 2}}).size(), 2u);
}

TEST(Tape, BridgesHollows) {
  // A "U": the tape goes straight over its mouth.
  const std::vector<Vec3> u{{0, 0, 0},  {3, 0, 0},  {3, 0, -3}, {2, 0, -3},
                            {2, 0, -1}, {1, 0, -1}, {1, 0, -3}, {0, 0, -3}};
  EXPECT_NEAR(tightTapeLength(u, {0, 1, 0}), 12, 1e-12);
  EXPECT_NEAR(lineLength(u, true), 16, 1e-12);
  EXPECT_GT(enclosedArea(tightTape(u, {0, 1, 0}), {0, 1, 0}), 0);
}

// Cavalieri's principle: the areas of the sections of any solid add up to its volume, whichever way it is cut.
TEST(Section, AreasAddUpToTheVolume) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    TriangleMesh m = ball({}, 1, 3);
    const Vec3 wave = numbers.point(4), stretch{numbers.between(0.5, 2), 1, numbers.between(0.5, 2)};
    for (Vec3& p : m.points) {  // still seen from its middle, with hollows
      p *= 1 + 0.35 * std::sin(dot(wave, p));
      p = {p.x * stretch.x, p.y * stretch.y, p.z * stretch.z};
    }
    const Vec3 normal = normalized(numbers.point(1));
    constexpr int kCuts = 4000;
    const double reach = 3, step = 2 * reach / kCuts;
    double sum = 0;
    for (int n = 0; n < kCuts; ++n)
      for (const SectionLoop& loop : section(m, {normal * (-reach + (n + 0.5) * step), normal})) {
        ASSERT_TRUE(loop.closed);
        sum += enclosedArea(loop.points, normal) * step;
        EXPECT_LE(tightTapeLength(loop.points, normal), lineLength(loop.points, true) + 1e-12);
      }
    EXPECT_NEAR(sum / volume(m), 1, 1e-4);
  }
}

}  // namespace
}  // namespace karinui
