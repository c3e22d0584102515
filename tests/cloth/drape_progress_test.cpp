#include "cloth/drape_progress.h"

#include <gtest/gtest.h>

namespace karinui {
namespace {

TEST(ToldProgress, IsEvenWhereTheForecastHolds) {
  ToldProgress told;
  for (int k = 0; k < 50; ++k) told.step(99 - k);
  EXPECT_NEAR(told.share(), 0.5, 0.02);
  EXPECT_EQ(told.stepsToGo(), 50);
}

// A drape seemed to be at its end, and slides on for hundreds of steps.
TEST(ToldProgress, IsNotFullBeforeTheEndAndTellsNoNumberThatGrows) {
  ToldProgress told;
  for (int k = 0; k < 40; ++k) told.step(440 - k);
  double before = told.share();
  for (int k = 0; k < 400; ++k) {
    told.step(900 - k);
    EXPECT_GE(told.share(), before);
    before = told.share();
    if (900 - k > 500) {
      EXPECT_FALSE(told.stepsToGo()) << k;
    }
  }
  EXPECT_LT(told.share(), 0.6) << "500 steps are to go";
  for (int k = 0; k < 500; ++k) told.step(500 - k);
  EXPECT_GT(told.share(), 0.98);
  EXPECT_EQ(told.stepsToGo(), 10);
}

}  // namespace
}  // namespace karinui
