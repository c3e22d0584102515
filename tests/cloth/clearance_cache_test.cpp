#include "cloth/clearance_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cloth/helpers.h"

namespace karinui::test {
namespace {

// A place that was far off is not asked about again before it may have come near. A field's slope may be the root of
// three.
TEST(ClearanceCache, WhatComesNearIsNeverOverlooked) {
  struct Steep : CapsuleBody {
    using CapsuleBody::CapsuleBody;
    mutable std::size_t asked = 0;
    double clearance(Vec3 p) const override { return ++asked, std::sqrt(3.0) * sample(p).distance; }
  };
  const Steep body({{{}, {}, 0.1}});
  std::mt19937_64 random(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100001) / 100000;
  };
  constexpr std::size_t kPlaces = 50, kSteps = 400;
  ClearanceCache cache(kPlaces);
  std::vector<Vec3> x(kPlaces);
  for (Vec3& p : x) p = {between(-0.3, 0.3), between(-0.3, 0.3), between(-0.3, 0.3)};
  std::size_t near = 0;
  for (std::size_t step = 0; step < kSteps; ++step)
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const double pace = step % 50 == 0 ? 0.2 : 0.004;
      x[k] += Vec3{between(-pace, pace), between(-pace, pace), between(-pace, pace)} - x[k] * 0.01;
      const bool is = std::sqrt(3.0) * body.sample(x[k]).distance < 0.0015;
      near += is;
      EXPECT_EQ(cache.sampleWithin(body, k, x[k], 0.0015).has_value(), is) << step;
    }
  EXPECT_GT(near, 1000u);
  EXPECT_LT(body.asked, kPlaces * kSteps / 2 + near);  // it spares something
}

}  // namespace
}  // namespace karinui::test
