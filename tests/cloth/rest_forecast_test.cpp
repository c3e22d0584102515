#include "cloth/rest_forecast.h"

#include <gtest/gtest.h>

#include <random>

namespace karinui {
namespace {

TEST(RestForecast, AnEvenDecayIsFollowedToItsEnd) {
  RestForecast forecast;
  for (int k = 0; k < 100; ++k) forecast.add(1e-3 * std::pow(0.95, k));
  // 1e-3 * 0.95^k = 3e-8 at k = 203; the window's middle lies seven steps back.
  ASSERT_TRUE(forecast.stepsLeft());
  EXPECT_NEAR(*forecast.stepsLeft(), 203.0 - 92, 1);
}

TEST(RestForecast, SnappingFoldsBlurItButDoNotStopIt) {
  std::mt19937 random(3);
  std::normal_distribution<double> snap(0, 0.6);
  for (const double kept : {0.9, 0.95}) {
    RestForecast forecast;
    for (int k = 0; k < 60; ++k) forecast.add((k % 7 ? 1e-3 : -1e-3) * std::pow(kept, k) * std::exp(snap(random)));
    ASSERT_TRUE(forecast.stepsLeft()) << kept;
    const double end = std::log(3e-5) / std::log(kept);
    EXPECT_GT(*forecast.stepsLeft(), 0.4 * (end - 60)) << kept;
    EXPECT_LT(*forecast.stepsLeft(), 2.5 * (end - 60)) << kept;
  }
}

TEST(RestForecast, NothingIsSaidOfWhatDoesNotShrink) {
  RestForecast forecast;
  for (int k = 0; k < 20; ++k) forecast.add(1e-4);
  EXPECT_FALSE(forecast.stepsLeft());
  for (int k = 0; k < 80; ++k) forecast.add(k % 2 ? 1e-4 : 2e-4);
  EXPECT_FALSE(forecast.stepsLeft());
  forecast.add(0);  // no move at all
  EXPECT_TRUE(!forecast.stepsLeft() || *forecast.stepsLeft() >= 0);
}

}  // namespace
}  // namespace karinui
