#include "karinui/geometry/bvh.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace karinui {
namespace {

using test::append;
using test::ball;
using test::box;
using test::Numbers;

TriangleMesh soup(unsigned seed, int faces) {
  Numbers numbers(seed);
  TriangleMesh m;
  for (int f = 0; f < faces; ++f) {
    const Vec3 centre = numbers.point(1);
    for (int k = 0; k < 3; ++k) m.points.push_back(centre + numbers.point(0.2));
    const auto base = static_cast<std::uint32_t>(3 * f);
    m.faces.push_back({base, base + 1, base + 2});
  }
  return m;
}

TriangleMesh onlyFace(const TriangleMesh& m, std::uint32_t f) { return {m.points, {m.faces[f]}}; }

TEST(Bvh, FindsWhatTryingEveryFaceFinds) {
  const TriangleMesh m = soup(1, 300);
  const Bvh bvh(m);
  std::vector<Bvh> single;
  for (std::uint32_t f = 0; f < m.faces.size(); ++f) single.emplace_back(onlyFace(m, f));
  Numbers numbers(2);
  for (int n = 0; n < 200; ++n) {
    const Vec3 from = numbers.point(1.5), along = normalized(numbers.point(1));
    double nearest = 1e9, first = 1e9;
    std::size_t hits = 0;
    for (const Bvh& one : single) {
      nearest = std::min(nearest, one.nearest(from)->distance);
      if (const auto hit = one.first(from, along)) first = std::min(first, hit->along), ++hits;
    }
    const auto near = bvh.nearest(from);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->distance, nearest);
    EXPECT_NEAR(distance(near->point, from), nearest, 1e-15);
    EXPECT_LT(distance(at(m, near->place), near->point), 1e-14);
    EXPECT_FALSE(bvh.nearest(from, nearest * (1 - 1e-9)));
    EXPECT_TRUE(bvh.nearest(from, nearest * (1 + 1e-9)));
    const auto hit = bvh.first(from, along);
    EXPECT_EQ(hit.has_value(), hits > 0);
    if (hit) {
      EXPECT_EQ(hit->along, first);
    }
    EXPECT_EQ(bvh.all(from, along).size(), hits);
  }
}

TEST(Bvh, TouchingFindsEveryFaceWhoseBoxMeetsTheBox) {
  const TriangleMesh m = soup(5, 500);
  const Bvh bvh(m);
  Numbers numbers(6);
  for (int n = 0; n < 50; ++n) {
    Box asked;
    asked.include(numbers.point(1));
    asked.include(asked.low + numbers.point(0.3));
    std::vector<std::uint32_t> found, expected;
    bvh.touching(asked, [&](std::uint32_t f) { found.push_back(f); });
    for (std::uint32_t f = 0; f < m.faces.size(); ++f) {
      Box b;
      for (std::uint32_t i : m.faces[f]) b.include(m.points[i]);
      if (b.low.x <= asked.high.x && asked.low.x <= b.high.x && b.low.y <= asked.high.y && asked.low.y <= b.high.y &&
          b.low.z <= asked.high.z && asked.low.z <= b.high.z)
        expected.push_back(f);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(Bvh, RaysThroughABallEnterAndLeaveOnce) {
  // Through corners and along edges too: no ray slips between two faces, none is counted twice.
  const TriangleMesh m = ball({}, 1, 3);
  const Bvh bvh(m);
  for (const Vec3& corner : m.points) {
    const auto hits = bvh.all(corner * 3, -corner);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_TRUE(hits[0].outside);
    EXPECT_FALSE(hits[1].outside);
    EXPECT_NEAR(hits[0].along, 2, 1e-12);
    EXPECT_NEAR(hits[1].along, 4, 1e-12);
  }
  for (const Triangle& f : m.faces) {
    const Vec3 middle = normalized(m.points[f[0]] + m.points[f[1]]);
    EXPECT_EQ(bvh.all(middle * 2, -middle).size(), 2u);
    const auto hit = bvh.first({}, middle);
    ASSERT_TRUE(hit);
    EXPECT_FALSE(hit->outside);
  }
  EXPECT_FALSE(bvh.first({0, 0, 3}, {0, 0, 1}));
  EXPECT_FALSE(bvh.first({0, 3, 0}, {0, 0, 1}));
}

TEST(Bvh, WindingNumberIsOneInsideAndZeroOutside) {
  const Bvh bvh(ball({}, 1, 5));
  Numbers numbers(9);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = numbers.point(2);
    const double r = length(p);
    if (std::fabs(r - 1) < 0.01) continue;
    EXPECT_NEAR(bvh.windingNumber(p), r < 1 ? 1 : 0, 0.02) << r;
    EXPECT_NEAR(bvh.signedDistance(p), r - 1, 2e-3);
  }
}

TEST(Bvh, SignSurvivesAHoleAndACrossing) {
  TriangleMesh m = ball({}, 1, 4);
  append(m, ball({0.9, 0, 0}, 0.4, 3));  // crosses the first
  m.faces.erase(m.faces.begin() + 100, m.faces.begin() + 103);
  const Bvh bvh(m);
  EXPECT_LT(bvh.signedDistance({0.2, 0.1, 0}), 0);
  EXPECT_LT(bvh.signedDistance({0.9, 0, 0}), 0);  // inside both
  EXPECT_LT(bvh.signedDistance({1.2, 0, 0}), 0);  // inside the second only
  EXPECT_GT(bvh.signedDistance({1.4, 0, 0}), 0);
  EXPECT_GT(bvh.signedDistance({0, 1.1, 0}), 0);
}

TEST(Bvh, StandsDegenerateMeshes) {
  const Bvh nothing{TriangleMesh{}};
  EXPECT_FALSE(nothing.nearest({}));
  EXPECT_FALSE(nothing.first({}, {1, 0, 0}));
  EXPECT_TRUE(std::isinf(nothing.signedDistance({})));

  TriangleMesh heap;  // a thousand copies of the same face, and faces without area
  heap.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  heap.faces.assign(1000, {0, 1, 2});
  heap.faces.insert(heap.faces.end(), 100, {1, 1, 1});
  const Bvh same(heap);
  EXPECT_NEAR(same.nearest({0.2, 0.2, 3})->distance, 3, 1e-15);

  TriangleMesh spiral;  // sizes from 1e-12 to 1e12: the splitting must still come to an end
  for (int i = 0; i < 2000; ++i) {
    const double s = std::pow(10.0, -12 + 24 * i / 2000.0);
    spiral.points.insert(spiral.points.end(), {{s, 0, 0}, {0, s, 0}, {0, 0, s}});
    const auto base = static_cast<std::uint32_t>(3 * i);
    spiral.faces.push_back({base, base + 1, base + 2});
  }
  EXPECT_LT(Bvh(spiral).nearest({})->distance, 1e-12);

  TriangleMesh broken = box({0, 0, 0}, {1, 1, 1});
  broken.points[3].x = std::numeric_limits<double>::quiet_NaN();
  const Bvh survives(broken);
  EXPECT_TRUE(survives.nearest({2, 2, 2}));
}

}  // namespace
}  // namespace karinui
