#include "karinui/geometry/mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/predicates.h"
#include "geometry/shapes.h"
#include "geometry/triangle.h"

namespace karinui {
namespace {

using test::append;
using test::ball;
using test::box;
using test::Numbers;

TEST(Mesh, ABoxIsClosedAndFacesOutward) {
  const TriangleMesh m = box({-1, 0, 2}, {1, 3, 4});
  const MeshReport r = inspect(m);
  EXPECT_TRUE(r.closed());
  EXPECT_TRUE(r.outward);
  EXPECT_EQ(r.triangles, 12u);
  EXPECT_EQ(r.points, 8u);
  EXPECT_EQ(r.shells, 1u);
  EXPECT_EQ(r.selfCrossings, 0u);
  EXPECT_DOUBLE_EQ(volume(m), 12);
  EXPECT_DOUBLE_EQ(area(m), 2 * (6 + 4 + 6));
  EXPECT_EQ(faceNormal(m, 0), (Vec3{0, 0, -1}));
}

TEST(Mesh, FaultsAreCounted) {
  TriangleMesh open = box({0, 0, 0}, {1, 1, 1});
  open.faces.pop_back();
  EXPECT_EQ(inspect(open).openEdges, 3u);
  EXPECT_FALSE(inspect(open).closed());

  TriangleMesh flipped = box({0, 0, 0}, {1, 1, 1});
  std::swap(flipped.faces[3][0], flipped.faces[3][1]);
  EXPECT_EQ(inspect(flipped).flippedEdges, 3u);

  TriangleMesh fin = box({0, 0, 0}, {1, 1, 1});
  fin.points.push_back({2, 2, 2});
  fin.faces.push_back({0, 1, 8});
  EXPECT_EQ(inspect(fin).nonManifoldEdges, 1u);
  EXPECT_EQ(inspect(fin).openEdges, 2u);

  TriangleMesh inward = box({0, 0, 0}, {1, 1, 1});
  for (Triangle& f : inward.faces) std::swap(f[0], f[1]);
  EXPECT_FALSE(inspect(inward).outward);
  EXPECT_TRUE(inspect(inward).closed());

  TriangleMesh two = ball({0, 0, 0}, 1, 2);
  append(two, ball({5, 0, 0}, 1, 2));
  EXPECT_EQ(inspect(two).shells, 2u);
}

TEST(Mesh, NothingIsNotClosed) { EXPECT_FALSE(inspect({}).closed()); }

TEST(Mesh, NormalsOfABallPointFromItsCentre) {
  const TriangleMesh m = ball({1, 2, 3}, 0.5, 4);
  const std::vector<Vec3> normals = pointNormals(m);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_GT(dot(normals[i], normalized(m.points[i] - Vec3{1, 2, 3})), 0.999);
}

TEST(Mesh, TwoBallsCrossAndTheCountDoesNotDependOnOrder) {
  TriangleMesh m = ball({0, 0, 0}, 1, 3);
  append(m, ball({1.2, 0.13, 0.07}, 1, 3));
  const auto pairs = selfCrossings(m);
  EXPECT_GT(pairs.size(), 40u);
  std::size_t slow = 0;
  for (std::uint32_t f = 0; f < m.faces.size(); ++f)
    for (std::uint32_t g = f + 1; g < m.faces.size(); ++g) {
      const Triangle &a = m.faces[f], &b = m.faces[g];
      bool common = false;
      for (std::uint32_t i : a) common = common || i == b[0] || i == b[1] || i == b[2];
      slow += !common && passThrough({m.points[a[0]], m.points[a[1]], m.points[a[2]]},
                                     {m.points[b[0]], m.points[b[1]], m.points[b[2]]});
    }
  EXPECT_EQ(pairs.size(), slow);
}

// The plain definition: some edge of one goes through the inside of the other.
bool edgeGoesThrough(const Corners& edges, const Corners& face) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = edges[k], q = edges[(k + 1) % 3];
    if (side(face[0], face[1], face[2], p) * side(face[0], face[1], face[2], q) >= 0) continue;
    const int a = side(p, q, face[0], face[1]), b = side(p, q, face[1], face[2]), c = side(p, q, face[2], face[0]);
    if (a != 0 && a == b && b == c) return true;
  }
  return false;
}

TEST(Mesh, CrossingTrianglesAgreeWithEdgesThroughFaces) {
  Numbers numbers(7);
  int crossing = 0;
  for (int n = 0; n < 20000; ++n) {
    Corners a, b;
    for (Vec3& p : a) p = numbers.point(1);
    for (Vec3& p : b) p = numbers.point(1);
    const bool expected = edgeGoesThrough(a, b) || edgeGoesThrough(b, a);
    crossing += expected;
    ASSERT_EQ(passThrough(a, b), expected) << n;
    ASSERT_EQ(passThrough(b, a), expected) << n;
    ASSERT_EQ(passThrough({a[1], a[0], a[2]}, {b[2], b[0], b[1]}), expected) << n;
  }
  EXPECT_GT(crossing, 1000);
}

TEST(Mesh, TouchingTrianglesDoNotCross) {
  const Corners floor{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};
  EXPECT_FALSE(passThrough(floor, {Vec3{0.2, 0, 0.2}, Vec3{0.4, 1, 0.2}, Vec3{0.2, 1, 0.4}}));  // stands on a corner
  EXPECT_FALSE(passThrough(floor, {Vec3{0.1, 0, 0.1}, Vec3{0.4, 0, 0.1}, Vec3{0.2, 1, 0.2}}));  // stands on an edge
  EXPECT_FALSE(passThrough(floor, {Vec3{0.1, 0, 0.1}, Vec3{0.4, 0, 0.1}, Vec3{0.2, 0, 0.3}}));  // lies in it
  EXPECT_TRUE(passThrough(floor, {Vec3{0.2, -1e-17, 0.2}, Vec3{0.4, 1, 0.2}, Vec3{0.2, 1, 0.4}}));
}

TEST(Predicates, AreExactWhereRoundingWouldLie) {
  // Points of an exact plane, moved by the least possible amount.
  const Vec3 a{0.1, 0.1, 0.1}, b{0.7, 0.3, 0.1}, c{0.2, 0.9, 0.1};
  const Vec3 on{12.5, -3.25, 0.1};
  EXPECT_EQ(side(a, b, c, on), 0);
  EXPECT_EQ(side(a, b, c, {on.x, on.y, std::nextafter(0.1, 1)}), 1);
  EXPECT_EQ(side(a, b, c, {on.x, on.y, std::nextafter(0.1, 0)}), -1);
  for (const auto& [p, q, r, s] : {std::array{a, b, c, a}, {a, b, c, c}, {a, b, b, on}, {c, b, c, on}})
    EXPECT_EQ(side(p, q, r, s), 0) << "two at one place";
  // Kettner et al.'s example of a naive orientation going wrong: points near a diagonal.
  const double step = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Flat p{0.5 + i * step, 0.5 + j * step};
      const Flat q{12, 12}, r{24, 24};
      EXPECT_EQ(side(p, q, r), p.u < p.v ? 1 : p.u > p.v ? -1 : 0);
      EXPECT_EQ(side(p, q, r), side(q, r, p));
    }
  Numbers numbers(3);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = numbers.point(1), q = numbers.point(1), r = numbers.point(1);
    const Vec3 s = p + (q - p) * numbers.between(-1, 1) + (r - p) * numbers.between(-1, 1);
    const int here = side(p, q, r, s);
    EXPECT_EQ(here, side(q, r, p, s));
    EXPECT_EQ(here, -side(q, p, r, s));
    EXPECT_EQ(here, -side(p, q, s, r));
    EXPECT_EQ(here, side(r, s, p, q));
  }
}

TEST(Triangle, NearestPointBeatsEveryOther) {
  Numbers numbers(11);
  for (int n = 0; n < 500; ++n) {
    Corners t;
    for (Vec3& p : t) p = numbers.point(1);
    if (n % 5 == 0) t[2] = lerp(t[0], t[1], numbers.between(-1, 2));  // no area
    if (n % 25 == 0) t[1] = t[2] = t[0];                              // a point
    const Vec3 from = numbers.point(2);
    const auto w = nearestWeights(t, from);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    const double nearest = distance(from, t[0] * w[0] + t[1] * w[1] + t[2] * w[2]);
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 other = t[0] * (1 - (i + j) / 20.0) + t[1] * (i / 20.0) + t[2] * (j / 20.0);
        ASSERT_LE(nearest, distance(from, other) + 3e-6);
      }
  }
}

TEST(Triangle, SolidAngleOfAnOctant) {
  EXPECT_NEAR(solidAngle({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}), std::numbers::pi / 2, 1e-14);
}

TEST(Mesh, BodiesAreClosedWithFewCrossings) {
  const TriangleMesh m = test::readPlainObj(KARINUI_SHARED_DIR "/bodies/f_jis9ar.obj");
  if (m.faces.empty()) GTEST_SKIP() << "the shared bodies are not here";
  const MeshReport r = inspect(m);
  EXPECT_TRUE(r.closed());
  EXPECT_TRUE(r.outward);
  EXPECT_LT(r.selfCrossings, 400u);
}

}  // namespace
}  // namespace karinui
