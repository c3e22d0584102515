#include "cloth/rest_forecast.h"

#include <gtest/gtest.h>

#include <charconv>
#include <random>

#include "cloth/helpers.h"

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

// A cloth laid on a ball, given 45 steps: what is said never promises more than are left.
TEST(RestForecast, NoMoreStepsAreSaidThanAreTaken) {
  using namespace test;
  Fabric f = textbook(1000, 1e-5, 0.15);
  f.frictionBody = f.frictionCloth = 0.3;
  std::vector<ClothLevel> levels(1);
  addPiece(levels[0].cloth, gridLattice(20, 20, 0.05), f);
  levels[0].state = standingBy(levels[0].cloth, [](std::size_t, Flat p) { return Vec3{p.u - 0.5, 0.35, p.v - 0.47}; });
  SettleSettings settings;
  settings.maxSteps = 45;
  std::vector<int> said;
  const Token token([&](double, const Message& doing) {
    const std::string words = text(doing);
    if (const std::size_t at = words.find("some "); at != std::string::npos) {
      int steps = -1;
      std::from_chars(words.data() + at + 5, words.data() + words.size(), steps);
      said.push_back(steps);
    }
  });
  Workers workers(1);
  ASSERT_TRUE(settle(levels, CapsuleBody({{{}, {}, 0.3}}), settings, token, workers));
  ASSERT_FALSE(said.empty());
  for (const int steps : said) EXPECT_LE(steps, 20) << "thirty were taken before the first was said";
}

}  // namespace
}  // namespace karinui
