#include "karinui/geometry/fit_curve.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "geometry/shapes.h"
#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

double missOf(const Fitted& fit, const std::vector<Flat>& points) {
  double worst = 0;
  for (Flat p : points) {
    double best = 1e300;
    for (const Curve& curve : fit.curves)
      for (const Curve& c : curve.parts())
        for (int i = 0; i <= 2000; ++i) best = std::fmin(best, distance(c.at(i / 2000.0), p));
    worst = std::fmax(worst, best);
  }
  return worst;
}

void expectJoined(const Fitted& fit, const std::vector<Flat>& points) {
  EXPECT_EQ(fit.curves.front().start, points.front());
  EXPECT_EQ(fit.curves.back().end, points.back());
  for (std::size_t i = 0; i + 1 < fit.curves.size(); ++i) {
    EXPECT_EQ(fit.curves[i].end, fit.curves[i + 1].start);
    const Flat a = normalized(fit.curves[i].tangent(1)), b = normalized(fit.curves[i + 1].tangent(0));
    EXPECT_GT(dot(a, b), 1 - 1e-9);
  }
}

TEST(FitCurve, NearlyStraightPointsAreALine) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> wobble(-0.0003, 0.0003);
  std::vector<Flat> points{{0.1, 0.2}};
  for (int i = 1; i < 50; ++i) points.push_back({0.1 + 0.008 * i + wobble(random), 0.2 + 0.004 * i + wobble(random)});
  const Fitted fit = fitEdge(points);
  ASSERT_EQ(fit.curves.size(), 1u);
  EXPECT_EQ(fit.curves[0], Curve::line(points.front(), points.back()));
}

TEST(FitCurve, ACubicIsFoundAgain) {
  const Curve armhole = Curve::cubic({0, 0}, {-0.08, 0.02}, {-0.1, 0.12}, {-0.03, 0.2});
  std::vector<Flat> points;
  for (int i = 0; i <= 40; ++i) points.push_back(armhole.at(i / 40.0));
  const Fitted fit = fitEdge(points);
  ASSERT_EQ(fit.curves.size(), 1u);
  expectJoined(fit, points);
  EXPECT_LT(missOf(fit, points), 2e-4);
  EXPECT_NEAR(fit.curves[0].length(), armhole.length(), 2e-5);
}

TEST(FitCurve, AWavyLineIsAFewSmoothCubics) {
  std::vector<Flat> points;
  for (int i = 0; i <= 200; ++i) points.push_back({0.005 * i, 0.06 * std::sin(0.02 * std::numbers::pi * i)});
  const Fitted fit = fitEdge(points);
  expectJoined(fit, points);
  EXPECT_LT(missOf(fit, points), 3.5e-4);
  ASSERT_EQ(fit.curves.size(), 1u);
  const std::vector<Curve> chain = fit.curves[0].parts();
  expectJoined({chain, 0}, points);
  EXPECT_LE(chain.size(), 10u);
  EXPECT_GT(chain.size(), 1u);
}

TEST(FitCurve, KeepsGivenTangents) {
  std::vector<Flat> points;
  for (int i = 0; i <= 30; ++i) {
    const double a = 0.5 * std::numbers::pi * i / 30;
    points.push_back({0.08 * std::sin(a), -0.1 * std::cos(a)});
  }
  const Fitted fit = fitEdge(points, {}, Flat{1, 0}, Flat{0, 1});
  ASSERT_EQ(fit.curves.size(), 1u);
  EXPECT_NEAR(normalized(fit.curves[0].tangent(0)).v, 0, 1e-12);
  EXPECT_NEAR(normalized(fit.curves[0].tangent(1)).u, 0, 1e-12);
  EXPECT_LT(missOf(fit, points), 5e-4);
}

// Points that bend off in their last millimetre: free, a curve may end so; firm, it ends as the points near there go.
TEST(FitCurve, FirmEndsGoAsThePointsThere) {
  std::vector<Flat> points;
  for (int i = 0; i <= 40; ++i) points.push_back({0.01 * i, 0.05 * std::sin(0.1 * i)});
  points.push_back(points.back() + Flat{0.0002, -0.001});
  FitSettings firm;
  firm.firmEnds = 0.005;
  for (const int pieces : {1, 3}) {
    firm.pieces = pieces;
    const Fitted fit = fitEdge(points, firm);
    expectJoined(fit, points);
    const Flat start = normalized(fit.curves.front().tangent(0)), end = normalized(fit.curves.back().tangent(1));
    EXPECT_GT(dot(start, normalized(points[1] - points[0])), 1 - 1e-9);
    EXPECT_GT(dot(end, normalized(points.back() - points[points.size() - 3])), 1 - 1e-9);
    EXPECT_LT(missOf(fit, points), 1e-3);
  }
  const Fitted given = fitEdge(points, firm, Flat{0, 1}, Flat{1, 0});
  EXPECT_NEAR(normalized(given.curves.front().tangent(0)).u, 0, 1e-12) << "what is given stays";
  EXPECT_NEAR(normalized(given.curves.back().tangent(1)).v, 0, 1e-12);
}

TEST(FitCurve, AFixedNumberOfPiecesIsKept) {
  std::vector<Flat> points;
  for (int i = 0; i <= 60; ++i) points.push_back({0.006 * i, 0.12 * std::exp(-std::pow((i - 30) / 12.0, 2))});
  FitSettings three;
  three.pieces = 3;
  const Fitted fit = fitEdge(points, three);
  EXPECT_EQ(fit.curves.size(), 3u);
  expectJoined(fit, points);
  EXPECT_LT(missOf(fit, points), 3.5e-4);  // each a chain
}

TEST(FitCurve, TwoPointsAndRepeatedPointsAreHarmless) {
  EXPECT_EQ(fitEdge(std::vector<Flat>{{0, 0}, {1, 0}}).curves.size(), 1u);
  const Fitted fit = fitEdge(std::vector<Flat>{{0, 0}, {0, 0}, {0.1, 0.1}, {0.1, 0.1}, {0.2, 0}, {0.2, 0}});
  ASSERT_FALSE(fit.curves.empty());
  for (const Curve& c : fit.curves) EXPECT_TRUE(finite(c.control1) && finite(c.control2));
}

// To a micrometre, unlike missOf, which looks at places of the curve.
double fineMissOf(const Fitted& fit, const std::vector<Flat>& points) {
  double worst = 0;
  const std::vector<Flat> chords = fit.curves.front().flattened(2e-7);
  for (Flat p : points) {
    double best = 1e300;
    for (std::size_t i = 1; i < chords.size(); ++i)
      best = std::fmin(best, distanceToSegment(chords[i - 1], chords[i], p));
    worst = std::fmax(worst, best);
  }
  return worst;
}

// Curves drawn by lot, their points off by what a measured edge is off: the fit says truly how far it passes, and that
// is no more than it may.
TEST(FitCurve, PassesAnyMeasuredCurveAsNearAsItSays) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Numbers numbers(seed);
    std::vector<Flat> points{{numbers.between(-1, 1), numbers.between(-1, 1)}};
    const double bend = numbers.between(-2, 2), wave = numbers.between(1, 6), off = seed % 2 ? 0 : 0.0001;
    const int count = 30 + static_cast<int>(numbers.below(60));
    for (int i = 0; i < count; ++i) {
      const double way = bend * std::sin(wave * i / count);
      points.push_back(points.back() + Flat{std::cos(way), std::sin(way)} * 0.006);
    }
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      points[i] += Flat{numbers.between(-off, off), numbers.between(-off, off)};
    const FitSettings settings;
    const Fitted fit = fitEdge(points, settings);
    ASSERT_EQ(fit.curves.size(), 1u);
    expectJoined(fit, points);
    const double real = fineMissOf(fit, points);
    EXPECT_LE(fit.miss, std::max(settings.straight, settings.farthest) + 1e-6);
    EXPECT_LE(real, fit.miss + 1e-6);
    expectJoined({fit.curves[0].parts(), 0}, points);
    EXPECT_NEAR(fit.curves[0].length(), 0.006 * count, 0.006 * count * (off > 0 ? 0.01 : 0.002) + 1e-4);
    // The same points read backwards give a curve as near.
    std::vector<Flat> back(points.rbegin(), points.rend());
    EXPECT_LE(fineMissOf(fitEdge(back, settings), back), std::max(settings.straight, settings.farthest) + 1e-6);
  }
}

}  // namespace
}  // namespace karinui
