#include "karinui/geometry/curve.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

Curve randomCurve(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto place = [&] { return Flat{unit(random), unit(random)}; };
  switch (random() % 3) {
    case 0:
      return Curve::line(place(), place());
    case 1:
      return Curve::cubic(place(), place(), place(), place());
    default:
      return Curve::arc(place(), place(), 2 * unit(random));
  }
}

TEST(Curve, closedForms) {
  EXPECT_NEAR(Curve::arc({1, 0}, {-1, 0}, 1).length(), std::numbers::pi, 1e-14);
  EXPECT_LT(distance(Curve::arc({1, 0}, {-1, 0}, 1).at(0.5), {0, 1}), 1e-15);  // counter-clockwise
  EXPECT_NEAR(Curve::arc({0, 0}, {1, 0}, 1e-12).length(), 1, 1e-12);
  // y = x^2 as a cubic; length of the parabola over [0, 1].
  const Curve parabola = Curve::cubic({0, 0}, {1.0 / 3, 0}, {2.0 / 3, 1.0 / 3}, {1, 1});
  EXPECT_NEAR(parabola.length(), std::sqrt(5) / 2 + std::asinh(2) / 4, 1e-11);
}

TEST(Curve, partsReversesMirrorsAndChords) {
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    const Curve curve = randomCurve(random);
    const double whole = curve.length();
    EXPECT_NEAR(curve.reversed().length(), whole, 1e-9);
    EXPECT_NEAR(curve.mirrored({0.2, 0.1}, {0.6, 0.8}).length(), whole, 1e-9);
    EXPECT_NEAR(curve.part(0, 0.4).length() + curve.part(0.4, 1).length(), whole, 1e-9);
    EXPECT_LT(distance(curve.part(0.2, 0.7).at(0.5), curve.at(0.45)), 1e-12);
    EXPECT_NEAR(curve.lengthTo(curve.parameterAt(0.3 * whole)), 0.3 * whole, 1e-9);
    const double miss = 1e-4;
    const auto chords = curve.flattened(miss);
    EXPECT_EQ(chords.front(), curve.start);
    EXPECT_EQ(chords.back(), curve.end);
    for (int n = 0; n <= 500; ++n) {
      double near = 1;
      for (std::size_t c = 0; c + 1 < chords.size(); ++c)
        near = std::min(near, distanceToSegment(chords[c], chords[c + 1], curve.at(n / 500.0)));
      EXPECT_LE(near, miss * (1 + 1e-9));
    }
  }
}

TEST(Triangulate, fillsRandomPolygonsExactly) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 200; ++k) {
    Ring ring;
    const int count = 5 + static_cast<int>(random() % 60);
    for (int n = 0; n < count; ++n) {
      const double a = 2 * std::numbers::pi * n / count, r = 0.2 + unit(random);
      ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    std::vector<Ring> holes{{{0.05, 0}, {0, 0.05}, {-0.05, 0}, {0, -0.05}}};
    const auto faces = triangulate(ring, holes, {});
    ASSERT_TRUE(faces);
    std::vector<Flat> points = ring;
    points.insert(points.end(), holes[0].begin(), holes[0].end());
    double area = 0;
    for (const Triangle& f : *faces) area += cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]) / 2;
    EXPECT_NEAR(area, signedArea(ring) - 0.005, 1e-9);
    EXPECT_EQ(faces->size(), points.size());  // n + h - 2 + 2 holes
  }
  EXPECT_FALSE(triangulate(Ring{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}, {}));
  EXPECT_TRUE(crossing(Ring{{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(crossing(Ring{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

}  // namespace
}  // namespace karinui
