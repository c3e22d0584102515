#include "cloth/skin_collider.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "karinui/geometry/bvh.h"

namespace karinui::test {
namespace {

// A ball with bumps, its points some 8 mm apart.
TriangleMesh bumpyBall() {
  constexpr std::uint32_t kRound = 60, kUp = 30;
  constexpr double kRadius = 0.08;
  TriangleMesh mesh;
  for (std::uint32_t j = 1; j < kUp; ++j)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      const double a = 2 * std::numbers::pi * i / kRound, b = std::numbers::pi * j / kUp;
      const double r = kRadius * (1 + 0.06 * std::sin(5 * a) * std::sin(4 * b));
      mesh.points.push_back({r * std::sin(b) * std::cos(a), r * std::cos(b), -r * std::sin(b) * std::sin(a)});
    }
  const auto at = [](std::uint32_t j, std::uint32_t i) { return j * kRound + i % kRound; };
  for (std::uint32_t j = 0; j + 2 < kUp; ++j)
    for (std::uint32_t i = 0; i < kRound; ++i) {
      mesh.faces.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      mesh.faces.push_back({at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  return mesh;
}

TEST(SkinCollider, DistancesAreRightNearTheSkinAndToldAtOnceWithTheClearance) {
  const TriangleMesh mesh = bumpyBall();
  const Bvh bvh(mesh);
  SkinCollider skin(mesh.faces, mesh.points.size());
  Workers workers(1);
  skin.moveTo(mesh.points, workers);
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100001) / 100000;
  };
  std::size_t near = 0;
  for (int k = 0; k < 20000; ++k) {
    // Not above the holes at both ends.
    const double a = between(0, 2 * std::numbers::pi), b = between(0.2, 0.8) * std::numbers::pi;
    const Vec3 place =
        Vec3{std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)} * (0.08 + between(-0.015, 0.03));
    const Collider::Sample sample = skin.sample(place);
    const double within = between(0, 0.025);
    double clearance = -1;
    const auto both = skin.sampleWithin(place, within, clearance);
    EXPECT_EQ(clearance, skin.clearance(place));
    ASSERT_EQ(both.has_value(), clearance < within);
    if (both) {
      EXPECT_TRUE(both->distance == sample.distance && both->normal == sample.normal);
    }
    const double exact = bvh.nearest(place)->distance;
    if (exact > 0.012) continue;
    ++near;
    EXPECT_LE(clearance, exact + 1e-4);
    EXPECT_GE(std::fabs(sample.distance), exact - 1e-12);
    EXPECT_LE(std::fabs(sample.distance), exact + 1e-4);
  }
  EXPECT_GT(near, 5000u);
}

}  // namespace
}  // namespace karinui::test
