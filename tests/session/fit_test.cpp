#include "karinui/session/fit.h"

#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

double ellipse(double a, double b) {  // Ramanujan
  const double h = std::pow((a - b) / (a + b), 2);
  return std::numbers::pi * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

// Two panels, 40 cm wide and 30 cm apart, before and behind.
FittingPtr panelsRoundAnEgg() {
  Workroom room;
  Document document;
  const auto lines =
      parseScript(std::string(kTwoPieces) + "move piece=front by=-20cm,0,15cm\nmove piece=back by=20cm,0,15cm\n");
  for (const ScriptLine& line : *lines) document = *apply(document, line.operation, room.context);
  return fittingOf(document, *Body::make(egg()));
}

TEST(Fit, TheLevelTapeGoesRoundGarmentAndBody) {
  const FittingPtr fitting = panelsRoundAnEgg();
  const Girths girths = girthsAt(*fitting, 0.4);
  const double share = std::sqrt(1 - 0.25);  // of the egg's half axes, half-way up
  EXPECT_NEAR(girths.body, ellipse(0.15 * share, 0.12 * share), 0.006);
  EXPECT_NEAR(girths.garment, 2 * (0.4 + 0.3), 0.001);
  EXPECT_EQ(girths.under.front(), girths.under.back());
  for (const Vec3 p : girths.round) EXPECT_NEAR(p.y, 0.4, 1e-9);
}

TEST(Fit, AboveTheGarmentOnlyTheBodyIsMeasured) {
  const Girths girths = girthsAt(*panelsRoundAnEgg(), 1.2);
  EXPECT_EQ(girths.garment, 0);
  EXPECT_TRUE(girths.round.empty());
  EXPECT_GT(girths.body, 0.5);
}

TEST(Fit, WhereOnlyOneSideHangsNothingGoesRound) {
  FittingPtr whole = panelsRoundAnEgg();
  Fitting half = *whole;
  half.frame.cloths.pop_back();
  EXPECT_EQ(girthsAt(half, 0.4).garment, 0);
}

TEST(Fit, TheTopOfAScaleIsRound) {
  std::vector<float> values(200, 0.03f);
  values.push_back(-1);
  values.push_back(9);  // one in a hundred may lie beyond
  EXPECT_DOUBLE_EQ(roundTop(values, 0.001), 0.05);
  EXPECT_DOUBLE_EQ(roundTop(values, 0.1), 0.1);
  EXPECT_EQ(roundTop({-1, 0}, 0.1), 0);
}

}  // namespace
}  // namespace karinui
