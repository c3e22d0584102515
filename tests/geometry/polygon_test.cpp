#include "karinui/geometry/polygon.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/predicates.h"
#include "geometry/shapes.h"

namespace karinui {
namespace {

using test::Numbers;

// A simple ring: radii drawn by lot around a middle, so that every place of it is seen from there.
Ring anyStar(Numbers& numbers, Flat middle = {}) {
  Ring ring;
  const int count = 5 + static_cast<int>(numbers.below(40));
  for (int n = 0; n < count; ++n) {
    const double a = 2 * std::numbers::pi * n / count, r = numbers.between(0.2, 1.2);
    ring.push_back(middle + Flat{r * std::cos(a), r * std::sin(a)});
  }
  return ring;
}

// The two rings that a chord from corner i to corner j leaves.
std::array<Ring, 2> cutApart(const Ring& ring, std::size_t i, std::size_t j) {
  const auto at = [&](std::size_t k) { return ring.begin() + static_cast<std::ptrdiff_t>(k); };
  Ring one(at(i), at(j) + 1), other(at(j), ring.end());
  other.insert(other.end(), ring.begin(), at(i) + 1);
  return {one, other};
}

TEST(Polygon, AreasAddUpWhereItIsCut) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    const Ring ring = anyStar(numbers, {numbers.between(-3, 3), numbers.between(-3, 3)});
    const std::size_t i = numbers.below(static_cast<std::uint32_t>(ring.size() - 3)),
                      j = i + 2 + numbers.below(static_cast<std::uint32_t>(ring.size() - i - 2));
    const auto [one, other] = cutApart(ring, i, j);
    EXPECT_NEAR(signedArea(one) + signedArea(other), signedArea(ring), 1e-12);  // whatever the chord crosses
    const double chord = distance(ring[i], ring[j]);
    EXPECT_NEAR(perimeter(one) + perimeter(other), perimeter(ring) + 2 * chord, 1e-12);
    Ring turned(ring.rbegin(), ring.rend());
    EXPECT_NEAR(signedArea(turned), -signedArea(ring), 1e-12);
    EXPECT_GT(signedArea(ring), 0);
  }
}

TEST(Polygon, HoldsWhatItsTrianglesHold) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    const Ring ring = anyStar(numbers);
    const auto faces = triangulate(ring, {}, {});
    ASSERT_TRUE(faces);
    for (int n = 0; n < 200; ++n) {
      const Flat p{numbers.between(-1.3, 1.3), numbers.between(-1.3, 1.3)};
      bool held = false;
      double near = 9;
      for (const Triangle& f : *faces) {
        const Flat a = ring[f[0]], b = ring[f[1]], c = ring[f[2]];
        held = held || (side(a, b, p) > 0 && side(b, c, p) > 0 && side(c, a, p) > 0);
      }
      for (std::size_t i = 0; i < ring.size(); ++i)  // tried at many places of each side
        for (int k = 0; k <= 200; ++k)
          near = std::min(near, distance(p, lerp(ring[i], ring[(i + 1) % ring.size()], k / 200.0)));
      EXPECT_EQ(contains(ring, p), held) << p.u << " " << p.v;
      EXPECT_LE(distanceToRing(ring, p), near + 1e-12);
      EXPECT_GE(distanceToRing(ring, p), near - 0.006);  // half a step of the places tried
    }
  }
}

TEST(Polygon, FindsWhetherARingCrossesItself) {
  int crossed = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    Ring ring;
    const std::uint32_t count = 4 + numbers.below(4);
    for (std::uint32_t n = 0; n < count; ++n) ring.push_back({numbers.between(0, 1), numbers.between(0, 1)});
    bool expected = false;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 2; j < count; ++j) {
        if (i == 0 && j + 1 == count) continue;  // they share a corner
        const Flat a = ring[i], b = ring[i + 1], c = ring[j], d = ring[(j + 1) % count];
        expected = expected || (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0);
      }
    const auto where = crossing(ring);
    ASSERT_EQ(where.has_value(), expected);
    crossed += expected;
    if (where) {
      int sides = 0;  // at the place told, two sides meet
      for (std::size_t i = 0; i < count; ++i) sides += distanceToSegment(ring[i], ring[(i + 1) % count], *where) < 1e-9;
      EXPECT_GE(sides, 2);
    }
    EXPECT_EQ(bool(triangulate(ring, {}, {})), !expected);
  }
  EXPECT_GT(crossed, 100);
  EXPECT_LT(crossed, 380);
}

// The ring, a hole and places inside: the triangles fill what is left, use every place once round and overlap nowhere.
TEST(Polygon, TrianglesFillARegionWithAHoleAndInnerPlaces) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    Ring ring = anyStar(numbers);
    std::vector<Ring> holes{{{0.06, 0}, {0, 0.06}, {-0.06, 0}, {0, -0.06}}};
    std::vector<Flat> inner;
    for (int n = 0; n < 200 && inner.size() < 30; ++n) {
      const Flat p{numbers.between(-1, 1), numbers.between(-1, 1)};
      if (contains(ring, p) && !contains(holes[0], p) && distanceToRing(ring, p) > 1e-3 &&
          distanceToRing(holes[0], p) > 1e-3)
        inner.push_back(p);
    }
    const double squeezed = seed % 3 == 0 ? 1e-3 : 1;  // a third of them thin strips
    for (std::vector<Flat>* each : {&ring, &holes[0], &inner})
      for (Flat& p : *each) p.v *= squeezed;
    const auto faces = triangulate(ring, holes, inner);
    ASSERT_TRUE(faces);
    std::vector<Flat> points = ring;
    points.insert(points.end(), holes[0].begin(), holes[0].end());
    points.insert(points.end(), inner.begin(), inner.end());
    EXPECT_EQ(faces->size(), points.size() + inner.size());  // Euler: n - 2 + 2 holes, 2 more for each inner place
    std::vector<double> turn(points.size(), 0);
    double area = 0;
    for (const Triangle& f : *faces) {
      area += cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]) / 2;
      for (std::size_t k = 0; k < 3; ++k) {
        const Flat a = points[f[(k + 1) % 3]] - points[f[k]], b = points[f[(k + 2) % 3]] - points[f[k]];
        EXPECT_GT(cross(a, b), 0);
        turn[f[k]] += std::atan2(cross(a, b), dot(a, b));
      }
    }
    EXPECT_NEAR(area, signedArea(ring) - signedArea(holes[0]), 1e-12);
    for (std::size_t i = points.size() - inner.size(); i < points.size(); ++i)
      EXPECT_NEAR(turn[i], 2 * std::numbers::pi, 1e-9) << "all round an inner place";
  }
}

}  // namespace
}  // namespace karinui
