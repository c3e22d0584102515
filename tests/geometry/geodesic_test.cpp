#include "karinui/geometry/geodesic.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/shapes.h"
#include "geometry/surfaces.h"

namespace karinui {
namespace {

// Every step lies in one face, the length is that of the points, and no place between the ends is inside a face.
void expectSound(const TriangleMesh& mesh, const SurfacePath& path) {
  ASSERT_EQ(path.places.size(), path.points.size());
  double sum = 0;
  for (std::size_t i = 0; i < path.places.size(); ++i) {
    EXPECT_LT(distance(at(mesh, path.places[i]), path.points[i]), 1e-12);
    if (i > 0) sum += distance(path.points[i - 1], path.points[i]);
    if (i == 0 || i + 1 == path.places.size()) continue;
    const auto& w = path.places[i].weight;
    EXPECT_TRUE(w[0] == 0 || w[1] == 0 || w[2] == 0);
  }
  EXPECT_NEAR(sum, path.length, 1e-12);
}

TEST(Geodesic, IsTheStraightLineOnAPlane) {
  const TriangleMesh mesh = surfaces::plane(37, 1.0);
  const SurfaceGuide guide(mesh);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> face(0, static_cast<std::uint32_t>(mesh.faces.size()) - 1);
  std::uniform_real_distribution<double> share(0, 1);
  const auto place = [&] {
    const double a = share(random), b = share(random) * (1 - a);
    return SurfacePoint{face(random), {a, b, 1 - a - b}};
  };
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint a = place(), b = place();
    const auto path = guide.straight(a, b);
    ASSERT_TRUE(path);
    expectSound(mesh, *path);
    EXPECT_NEAR(path->length, distance(at(mesh, a), at(mesh, b)), 1e-9);
  }
}

TEST(Geodesic, FromCornersAndEdgesIsStraightToo) {
  const TriangleMesh mesh = surfaces::plane(10, 1.0);
  const SurfaceGuide guide(mesh);
  for (std::uint32_t f = 0; f < mesh.faces.size(); f += 7)
    for (std::uint32_t g = 3; g < mesh.faces.size(); g += 11)
      for (const auto& w : {std::array<double, 3>{1, 0, 0}, std::array<double, 3>{0.5, 0.5, 0}}) {
        const SurfacePoint a{f, w}, b{g, {0, 1, 0}};
        const auto path = guide.straight(a, b);
        ASSERT_TRUE(path);
        expectSound(mesh, *path);
        EXPECT_NEAR(path->length, distance(at(mesh, a), at(mesh, b)), 1e-9);
      }
}

TEST(Geodesic, OnACylinderIsAHelix) {
  const double r = 0.15;
  const TriangleMesh mesh = surfaces::cylinder(200, 60, r, 0.6);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  for (double turn : {0.3, 1.1, 2.0, 2.9})
    for (double rise : {0.0, 0.2, 0.45}) {
      const auto on = [&](double a, double y) { return surfaces::nearest(bvh, {r * std::sin(a), y, r * std::cos(a)}); };
      const auto path = guide.straight(on(0.7, 0.1), on(0.7 + turn, 0.1 + rise));
      ASSERT_TRUE(path);
      expectSound(mesh, *path);
      EXPECT_NEAR(path->length, std::hypot(r * turn, rise), 0.001 * path->length);
    }
}

TEST(Geodesic, OnABallIsAGreatCircle) {
  const double r = 0.2;
  const TriangleMesh mesh = surfaces::ball(120, 60, r);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 60; ++i) {
    const Vec3 a = normalized({normal(random), normal(random), normal(random)}) * r;
    const Vec3 b = normalized({normal(random), normal(random), normal(random)}) * r;
    const double angle = std::atan2(length(cross(a, b)), dot(a, b));
    if (angle > 2.6) continue;  // nearly opposite: many ways are as short
    const auto path = guide.straight(surfaces::nearest(bvh, a), surfaces::nearest(bvh, b));
    ASSERT_TRUE(path);
    expectSound(mesh, *path);
    EXPECT_NEAR(path->length, r * angle, 0.002 * r * angle + 1e-5);
  }
}

TEST(Geodesic, ReadsTheSameBackwards) {
  const TriangleMesh mesh = surfaces::ball(40, 20, 0.2);
  const SurfaceGuide guide(mesh);
  const SurfacePoint a{17, {0.2, 0.3, 0.5}}, b{900, {0.6, 0.2, 0.2}};
  const auto there = guide.straight(a, b), back = guide.straight(b, a);
  ASSERT_TRUE(there && back);
  const SurfacePath turned = reversed(*back);
  ASSERT_EQ(there->places.size(), turned.places.size());
  for (std::size_t i = 0; i < turned.points.size(); ++i) EXPECT_EQ(there->points[i], turned.points[i]);
}

TEST(Geodesic, RefusesPlacesThatDoNotHangTogether) {
  TriangleMesh mesh = surfaces::plane(2, 1.0);
  const auto first = static_cast<std::uint32_t>(mesh.points.size()),
             faces = static_cast<std::uint32_t>(mesh.faces.size());
  const TriangleMesh other = surfaces::plane(2, 1.0);
  for (Vec3 p : other.points) mesh.points.push_back(p + Vec3{5, 0, 0});
  for (Triangle t : other.faces) mesh.faces.push_back({t[0] + first, t[1] + first, t[2] + first});
  const auto path = SurfaceGuide(mesh).straight({0, {1, 0, 0}}, {faces, {1, 0, 0}});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().kind, Error::Kind::Refused);
}

TEST(Geodesic, SectionStaysInItsPlane) {
  const TriangleMesh mesh = surfaces::ball(61, 31, 0.2);
  const Bvh bvh(mesh);
  const SurfaceGuide guide(mesh);
  const auto path =
      guide.section(surfaces::nearest(bvh, {0, 0.18, 0.08}), surfaces::nearest(bvh, {0, -0.15, 0.13}), {1, 0, 0}, 0);
  ASSERT_TRUE(path);
  expectSound(mesh, *path);
  for (Vec3 p : path->points) EXPECT_NEAR(p.x, 0, 1e-9);
  const double angle = std::atan2(0.18, 0.08) + std::atan2(0.15, 0.13);
  EXPECT_NEAR(path->length, 0.2 * angle, 0.002);
}

TEST(Geodesic, AlongFindsThePlaceAtAFraction) {
  const TriangleMesh mesh = surfaces::plane(9, 1.0);
  const auto path = SurfaceGuide(mesh).straight({0, {0.4, 0.3, 0.3}}, {150, {0.1, 0.2, 0.7}});
  ASSERT_TRUE(path);
  for (double f : {0.0, 0.13, 0.5, 0.87, 1.0})
    EXPECT_LT(distance(at(mesh, along(mesh, *path, f)), lerp(path->points.front(), path->points.back(), f)), 1e-9);
}

// A cone is developable: unrolled into the plane, the straight line between two places is the way round it.
TEST(Geodesic, OnAConeIsStraightInThePlane) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Numbers numbers(seed);
    const double low = numbers.between(0.12, 0.2), high = low * numbers.between(0.5, 0.8),
                 rise = numbers.between(0.3, 0.5);
    const TriangleMesh mesh = surfaces::cone(240, 60, low, high, rise);
    const Bvh bvh(mesh);
    const SurfaceGuide guide(mesh);
    const double slant = std::hypot(low - high, rise), sine = (low - high) / slant;  // half the angle at the apex
    for (int n = 0; n < 8; ++n) {
      // Both ends in the middle of the slant, and less than a third round: the way stays on the frustum.
      const double from = numbers.between(0, 6), by = numbers.between(-2, 2);
      const auto on = [&](double a, double t) {
        const double r = low + (high - low) * t;
        return surfaces::nearest(bvh, {r * std::sin(a), rise * t, r * std::cos(a)});
      };
      const double t0 = numbers.between(0.1, 0.35), t1 = numbers.between(0.1, 0.35);
      const auto path = guide.straight(on(from, t0), on(from + by, t1));
      ASSERT_TRUE(path);
      expectSound(mesh, *path);
      const double r0 = (low + (high - low) * t0) / sine, r1 = (low + (high - low) * t1) / sine, turn = by * sine;
      const double expected = std::sqrt(r0 * r0 + r1 * r1 - 2 * r0 * r1 * std::cos(turn));
      EXPECT_NEAR(path->length, expected, 0.002 * expected + 1e-5) << by;
    }
  }
}

// Lengths on a ball are a metric: no shorter than the chord, the same both ways, no longer than by a third place.
TEST(Geodesic, KeepsTheTriangleInequality) {
  const TriangleMesh mesh = test::ball({}, 0.2, 4);
  const SurfaceGuide guide(mesh);
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Numbers numbers(seed);
    const auto any = [&] {
      const double a = numbers.between(0, 1), b = numbers.between(0, 1 - a);
      return SurfacePoint{numbers.below(static_cast<std::uint32_t>(mesh.faces.size())), {a, b, 1 - a - b}};
    };
    const SurfacePoint a = any(), b = any(), c = any();
    const auto ab = guide.straight(a, b), ba = guide.straight(b, a), ac = guide.straight(a, c),
               cb = guide.straight(c, b);
    ASSERT_TRUE(ab && ba && ac && cb);
    EXPECT_EQ(ab->length, ba->length);
    EXPECT_GE(ab->length, distance(at(mesh, a), at(mesh, b)) - 1e-12);
    EXPECT_LE(ab->length, (ac->length + cb->length) * 1.001);
    const SurfacePoint half = along(mesh, *ab, 0.5);
    EXPECT_NEAR(guide.straight(a, half)->length, ab->length / 2, 0.001 * ab->length);
  }
}

}  // namespace
}  // namespace karinui
