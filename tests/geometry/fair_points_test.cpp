#include "karinui/geometry/fair_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace karinui {
namespace {

constexpr double kShortest = 0.12, kStep = 0.005;

std::vector<Flat> wave(double wavelength, double height) {
  std::vector<Flat> points;
  for (int k = 0; k <= 200; ++k)
    points.push_back({k * kStep, height * std::sin(2 * std::numbers::pi * k * kStep / wavelength)});
  return points;
}
double heightIn(const std::vector<Flat>& points) {  // away from the ends
  double most = 0;
  for (std::size_t k = 50; k + 50 < points.size(); ++k) most = std::fmax(most, std::fabs(points[k].v));
  return most;
}

TEST(FairPoints, LinesAndArcsStay) {
  for (const Flat p : withoutWaves(wave(1, 0), kShortest)) EXPECT_NEAR(p.v, 0, 1e-12);
  std::vector<Flat> arc;
  constexpr double kRadius = 0.1;
  for (int k = 0; k <= 60; ++k)
    arc.push_back({kRadius * std::cos(k * kStep / kRadius), kRadius * std::sin(k * kStep / kRadius)});
  for (const bool kept : {false, true})
    for (const Flat p : withoutWaves(arc, kShortest, {kept, kept})) EXPECT_NEAR(length(p), kRadius, kept ? 1e-4 : 1e-3);
}

// What is left of a wave is 1 / (1 + (shortest / length)^6) of it.
TEST(FairPoints, WavesGoByTheirLength) {
  for (const double wavelength : {0.05, 0.1, 0.12, 0.2, 0.5}) {
    const double left = heightIn(withoutWaves(wave(wavelength, 0.004), kShortest)) / 0.004;
    EXPECT_NEAR(left, 1 / (1 + std::pow(kShortest / wavelength, 6)), 0.03) << wavelength;
  }
}

TEST(FairPoints, EndsStayAndTheirDirectionsWhereTheyAreKept) {
  const std::vector<Flat> points = wave(0.08, 0.004);
  const std::vector<Flat> kept = withoutWaves(points, kShortest, {true, false});
  EXPECT_EQ(kept[0], points[0]);
  EXPECT_EQ(kept[1], points[1]);
  EXPECT_EQ(kept.back(), points.back());
  EXPECT_NE(kept[kept.size() - 2], points[points.size() - 2]);
  EXPECT_EQ(withoutWaves(std::vector<Flat>(5, Flat{1, 2}), kShortest), std::vector<Flat>(5, Flat{1, 2}));
}

}  // namespace
}  // namespace karinui
