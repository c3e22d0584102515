#include "geometry/delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/predicates.h"
#include "geometry/shapes.h"
#include "karinui/geometry/polygon.h"
#include "karinui/geometry/section.h"

namespace karinui {
namespace {

using test::Numbers;

// How deep d lies in the circle through a, b, c, over the circle's radius: > 0 inside.
double depthInCircle(Flat a, Flat b, Flat c, Flat d) {
  const Flat p = b - a, q = c - a;
  const double area = 2 * cross(p, q);
  const Flat off = (leftOf(p) * dot(q, q) - leftOf(q) * dot(p, p)) * (1 / area);
  const double radius = length(off);
  return (radius - distance(a + off, d)) / radius;
}

std::vector<Flat> scattered(Numbers& numbers, int kind, std::size_t count) {
  std::vector<Flat> places;
  while (places.size() < count) {
    const double u = numbers.between(0, 1), v = numbers.between(0, 1);
    if (kind == 0) places.push_back({u, v});
    if (kind == 1) places.push_back({std::floor(8 * u), std::floor(8 * v)});  // many equal, on lines and on circles
    if (kind == 2) places.push_back({u, 1e-4 * v});                           // a thin strip
    if (kind == 3) places.push_back({std::cos(7 * u) + 1e-3 * v, std::sin(7 * u)});
  }
  return places;
}

// Faces of the given corners only, counter-clockwise, which fill the hull of the places.
std::vector<Delaunay::Face> expectTriangulation(const Delaunay& made, const std::vector<Flat>& places,
                                                double least = 0.97) {
  std::vector<Delaunay::Face> real;
  std::set<std::array<std::uint32_t, 2>> runs;
  const auto at = [&](std::uint32_t corner) {
    const auto& of = made.cornerOf();
    return places[static_cast<std::size_t>(std::find(of.begin(), of.end(), corner) - of.begin())];
  };
  double area = 0;
  for (const Delaunay::Face& face : made.faces()) {
    if (!made.real(face)) continue;
    real.push_back(face);
    const Flat a = at(face.corner[0]), b = at(face.corner[1]), c = at(face.corner[2]);
    EXPECT_GE(cross(b - a, c - a), -1e-7);
    area += cross(b - a, c - a) / 2;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(runs.insert({face.corner[k], face.corner[(k + 1) % 3]}).second) << "a side has two faces";
  }
  // But for slivers at the rim, whose circles reach the corners of the triangle that held everything.
  const double hull = std::abs(signedArea(convexHull(places)));
  EXPECT_LE(area, hull * (1 + 1e-6));
  EXPECT_GE(area, hull * least);
  return real;
}

TEST(Delaunay, NoPlaceLiesInACircle) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    const std::vector<Flat> places = scattered(numbers, static_cast<int>(seed % 4), 40 + numbers.below(120));
    const Delaunay made(places);
    ASSERT_EQ(made.cornerOf().size(), places.size());
    std::vector<Flat> at(3 * places.size() + 3);
    for (std::size_t i = 0; i < places.size(); ++i) at[made.cornerOf()[i]] = places[i];
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(made.cornerOf()[i] == made.cornerOf()[j], places[i] == places[j]);
    std::set<std::uint32_t> used;
    for (const Delaunay::Face& face : expectTriangulation(made, places, seed % 4 == 2 ? 0.1 : 0.97)) {
      const Flat a = at[face.corner[0]], b = at[face.corner[1]], c = at[face.corner[2]];
      used.insert(face.corner.begin(), face.corner.end());
      const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
      if (cross(b - a, c - a) < 1e-6 * longest * longest) continue;  // its circle is not to be told in doubles
      for (const Flat& d : places) EXPECT_LT(depthInCircle(a, b, c, d), 1e-5);
    }
    std::set<std::uint32_t> corners(made.cornerOf().begin(), made.cornerOf().end());
    if (seed % 4 != 2) {
      EXPECT_EQ(used, corners) << "every place is a corner";
    }
  }
}

// Sides drawn by lot are forced in where they cross none before; the others become Delaunay again.
TEST(Delaunay, KeepsWhatIsForcedAndImprovesTheRest) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    const std::vector<Flat> places = scattered(numbers, 0, 60);
    Delaunay made(places);
    const auto& corner = made.cornerOf();
    std::vector<std::array<std::size_t, 2>> kept;
    int crossed = 0;
    for (int n = 0; n < 25; ++n) {
      const std::size_t a = numbers.below(60), b = numbers.below(60);
      if (a == b) continue;
      bool free = true;
      for (const auto& [c, d] : kept) {
        if (a == c || a == d || b == c || b == d) continue;
        free = free && !(side(places[a], places[b], places[c]) * side(places[a], places[b], places[d]) < 0 &&
                         side(places[c], places[d], places[a]) * side(places[c], places[d], places[b]) < 0);
      }
      std::array<std::uint32_t, 2> met{};
      const auto done = made.force(corner[a], corner[b], met);
      ASSERT_EQ(done, free ? Delaunay::Forced::Made : Delaunay::Forced::Crossed);
      if (free) {
        kept.push_back({a, b});
      } else {
        ++crossed;
        EXPECT_TRUE(made.forced(met[0], met[1]));
      }
    }
    EXPECT_GT(crossed, 0);
    made.improve();
    for (const auto& [a, b] : kept) {
      EXPECT_TRUE(made.forced(corner[a], corner[b]));
      EXPECT_NE(made.leftOf(corner[a], corner[b]), Delaunay::kNone);
    }
    std::vector<Flat> at(3 * places.size() + 3);
    for (std::size_t i = 0; i < places.size(); ++i) at[corner[i]] = places[i];
    for (const Delaunay::Face& face : expectTriangulation(made, places))
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t across = face.beyond[k];
        const std::uint32_t b = face.corner[(k + 1) % 3], c = face.corner[(k + 2) % 3];
        if (across == Delaunay::kNone || !made.real(made.faces()[across]) || made.forced(b, c)) continue;
        for (const std::uint32_t d : made.faces()[across].corner)
          if (d != b && d != c) {
            EXPECT_LT(depthInCircle(at[face.corner[k]], at[b], at[c], at[d]), 1e-5);
          }
      }
  }
}

TEST(Delaunay, APlaceOnTheWayIsTold) {
  Delaunay made(std::vector<Flat>{{0, 0}, {1, 0}, {2, 0}, {1, 1}, {1, -1}});
  std::array<std::uint32_t, 2> met{};
  const auto& corner = made.cornerOf();
  EXPECT_EQ(made.force(corner[0], corner[2], met), Delaunay::Forced::Touched);
  EXPECT_EQ(met[0], corner[1]);
}

}  // namespace
}  // namespace karinui
