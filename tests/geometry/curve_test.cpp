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

// Three curves of any kind, joined: measured against the three.
TEST(Curve, walksEvenly) {
  std::mt19937 random(3);
  for (int k = 0; k < 200; ++k) {
    Curve curve = randomCurve(random);
    if (k % 3 == 0) curve = Curve::joined(std::vector{curve, Curve::cubic(curve.end, {2, 0}, {0, 2}, {1, 1})});
    const double from = k % 2 == 0 ? 0 : 0.2, to = k % 2 == 0 ? 1 : 0.7;
    const std::vector<Flat> walk = curve.evenly(from, to, 23);
    ASSERT_EQ(walk.size(), 24u);
    for (std::size_t i = 0; i < walk.size(); ++i)
      EXPECT_LT(distance(walk[i], curve.atFraction(from + (to - from) * static_cast<double>(i) / 23)), 1e-6);
  }
  EXPECT_LT(distance(Curve::cubic({0, 0}, {0, 0}, {0, 0}, {0, 0}).evenly(0, 1, 1).back(), {}), 1e-12);
}

TEST(Curve, aChainIsItsParts) {
  std::mt19937 random(2);
  for (int k = 0; k < 100; ++k) {
    std::vector<Curve> three{randomCurve(random), randomCurve(random), randomCurve(random)};
    for (std::size_t i = 1; i < 3; ++i) three[i].start = three[i - 1].end;
    const Curve chain = Curve::joined(three);
    double whole = 0;
    for (const Curve& curve : three) {
      EXPECT_NEAR(distance(chain.at(chain.parameterAt(whole + 0.3 * curve.length())), curve.atFraction(0.3)), 0, 2e-6);
      whole += curve.length();
    }
    EXPECT_NEAR(chain.length(), whole, 2e-6);
    EXPECT_EQ(chain.start, three.front().start);
    EXPECT_EQ(chain.end, three.back().end);
    EXPECT_EQ(Curve::joined(chain.parts()), chain);
    EXPECT_EQ(chain.reversed().reversed(), chain);
    EXPECT_LT(distance(chain.reversed().atFraction(0.2), chain.atFraction(0.8)), 1e-9);
    const Curve mirror = chain.mirrored({0.2, 0.1}, {0.6, 0.8});
    EXPECT_LT(distance(mirror.mirrored({0.2, 0.1}, {0.6, 0.8}).at(0.6), chain.at(0.6)), 1e-12);
    EXPECT_NEAR(chain.part(0, 0.4).length() + chain.part(0.4, 1).length(), chain.length(), 1e-9);
    const double from = chain.lengthTo(0.2), to = chain.lengthTo(0.7);
    const Curve part = chain.part(0.2, 0.7);
    EXPECT_NEAR(part.length(), to - from, 1e-9);
    EXPECT_LT(distance(part.atFraction(0.5), chain.at(chain.parameterAt((from + to) / 2))), 1e-8);
    EXPECT_NEAR(chain.lengthTo(chain.parameterAt(0.3 * whole)), 0.3 * whole, 1e-9);
    const double t = 0.31, h = 1e-7;
    EXPECT_LT(length((chain.at(t + h) - chain.at(t - h)) * (0.5 / h) - chain.tangent(t)), 1e-5);
    const auto chords = chain.flattened(1e-4);
    const double step = 1.0 / static_cast<double>(chords.size() - 1);
    for (std::size_t n = 0; n < chords.size(); ++n)
      EXPECT_LT(distance(chords[n], chain.at(static_cast<double>(n) * step)), 1e-12);
    for (std::size_t n = 0; n + 1 < chords.size(); ++n)
      EXPECT_LE(distanceToSegment(chords[n], chords[n + 1], chain.at((static_cast<double>(n) + 0.5) * step)), 1.001e-4);
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
