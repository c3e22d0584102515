#include "karinui/pattern/alteration.h"

#include <gtest/gtest.h>

namespace karinui {
namespace {

Outline skirt(double width, double height) {
  return {
      {{"hem", Curve::line({0, 0}, {width, 0})},
       {"side", Curve::cubic({width, 0}, {width, height / 3}, {width * 0.9, height * 2 / 3}, {width * 0.85, height})},
       {"waist", Curve::line({width * 0.85, height}, {0, height})},
       {"fold", Curve::line({0, height}, {0, 0})}}};
}

TEST(Alteration, GoesAsFarOnAnotherSize) {
  const Outline small = skirt(0.3, 0.6), large = skirt(0.35, 0.65);
  Outline altered = small;
  altered.edges[0].curve.end.u += 0.02;
  altered.edges[1].curve.start.u += 0.02;
  altered.edges[1].curve.control1.u += 0.01;
  const auto done = alteredAlike(small, altered, large);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->edges[0].curve.end, (Flat{0.35 + 0.02, 0}));
  EXPECT_NEAR(done->edges[1].curve.control1.u, 0.35 + 0.01, 1e-12);
  EXPECT_EQ(done->edges[2].curve, large.edges[2].curve);
  // Nothing done is nothing done, and the same size gets the very alteration.
  EXPECT_EQ(*alteredAlike(small, small, large), large);
  EXPECT_EQ(*alteredAlike(small, altered, small), altered);
}

TEST(Alteration, ANewCurveIsCarriedAlong) {
  const Outline small = skirt(0.3, 0.6), large = skirt(0.4, 0.6);
  Outline altered = small;
  altered.edges[0].curve = Curve::cubic({0, 0}, {0.1, -0.02}, {0.2, -0.02}, {0.3, 0});
  const auto done = alteredAlike(small, altered, large);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->edges[0].curve.kind, Curve::Kind::Cubic);
  EXPECT_EQ(done->edges[0].curve.end, (Flat{0.4, 0}));
  EXPECT_NEAR(done->edges[0].curve.control2.u, 0.2 + 0.1 * 2 / 3, 1e-12);
  EXPECT_NEAR(done->edges[0].curve.control2.v, -0.02, 1e-12);
}

TEST(Alteration, OtherEdgesAndNoOutlinesAreRefused) {
  const Outline small = skirt(0.3, 0.6);
  Outline other = skirt(0.35, 0.65), inside = small;
  other.edges[3].name = "cb";
  EXPECT_FALSE(alteredAlike(small, small, other));
  other.edges.pop_back();
  EXPECT_FALSE(alteredAlike(small, small, other));
  inside.edges[0].curve.end.u = inside.edges[1].curve.start.u = -0.2;
  EXPECT_FALSE(alteredAlike(small, inside, skirt(0.1, 0.6)));
}

}  // namespace
}  // namespace karinui
