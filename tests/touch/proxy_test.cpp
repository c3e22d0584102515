#include "karinui/touch/proxy.h"

#include <gtest/gtest.h>

#include <random>

#include "touch/hand.h"

namespace karinui {
namespace {

TEST(Proxy, StaysAboveTheTriangleTheDeviceIsBelow) {
  const TouchScene scene = floorScene();
  Proxy proxy;
  proxy.follow({0.001, 0.01, 0.002}, scene, 0);
  const auto contact = proxy.follow({0.001, -0.004, 0.002}, scene, 0);
  ASSERT_TRUE(contact.touching);
  EXPECT_NEAR(contact.depth, 0.004, 1e-9);
  EXPECT_NEAR(distance(contact.normal, {0, 1, 0}), 0, 1e-9);
  EXPECT_NEAR(distance(contact.proxy, {0.001, Proxy::kClear, 0.002}), 0, 1e-9);
}

TEST(Proxy, InFreeSpaceItIsWhereTheDeviceIs) {
  const TouchScene scene = floorScene();
  Proxy proxy;
  for (const Vec3 place : {Vec3{0, 0.01, 0}, Vec3{0.02, 0.001, 0}, Vec3{0, 0.03, -0.02}}) {
    EXPECT_FALSE(proxy.follow(place, scene, 0.5).touching);
    EXPECT_TRUE(proxy.place() == place);
  }
}

// A random walk in and around surfaces: the way of the proxy never crosses a facet from a side that is felt.
void neverPops(const TouchScene& scene, Vec3 start, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Proxy proxy;
  Vec3 device = start, aim = start;
  proxy.reset(device);
  int touched = 0;
  for (int k = 0; k < 20000; ++k) {
    if (k % 200 == 0) aim = Vec3{unit(random), unit(random), unit(random)} * size;
    device += (aim - device) * 0.02 + Vec3{unit(random), unit(random), unit(random)} * 2e-4;
    const Vec3 before = proxy.place();
    const auto contact = proxy.follow(device, scene, k % 400 < 200 ? 0.3 : 0.0);
    touched += contact.touching;
    for (const Facet& facet : scene.facets) {
      const double a = dot(facet.normal, before - facet.corner[0]);
      const double b = dot(facet.normal, contact.proxy - facet.corner[0]);
      if (a * b >= 0 || (a < 0 && !facet.twoSided)) continue;
      const Vec3 at = before + (contact.proxy - before) * (a / (a - b));
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i)
        inside =
            inside && dot(cross(facet.normal, facet.corner[(i + 1) % 3] - facet.corner[i]), at - facet.corner[i]) > 0;
      // A way within a tick may bend round an edge; a straight line that cuts it passes near the edge only.
      if (inside) {
        double near = 1;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 side = facet.corner[(i + 1) % 3] - facet.corner[i];
          near = std::min(near, length(cross(side, at - facet.corner[i])) / length(side));
        }
        ASSERT_LT(near, 2e-3) << "tick " << k;
      }
    }
  }
  EXPECT_GT(touched, 2000);
}

TEST(Proxy, DoesNotPopThroughAnEdgeOrACorner) { neverPops(boxScene({0.03, 0.03, 0.03}), {0.04, 0.04, 0.04}, 0.05, 1); }

TEST(Proxy, DoesNotPopThroughAThinPart) { neverPops(boxScene({0.03, 0.0002, 0.03}), {0, 0.02, 0}, 0.05, 2); }

TEST(Proxy, IsHeldByBothSidesOfRigidCloth) {
  TouchScene scene;
  for (const auto& facet :
       {facetOf({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, true), facetOf({-1, 0, -1}, {1, 0, 1}, {1, 0, -1}, true)})
    scene.facets.push_back(*facet);
  for (const double side : {1.0, -1.0}) {
    Proxy proxy;
    proxy.reset({0, 0.01 * side, 0});
    const auto contact = proxy.follow({0.003, -0.02 * side, 0.003}, scene, 0);
    EXPECT_TRUE(contact.touching);
    EXPECT_NEAR(contact.proxy.y, Proxy::kClear * side, 1e-9);
    EXPECT_NEAR(contact.normal.y, side, 1e-6);
  }
  neverPops(scene, {0, 0.01, 0}, 0.05, 3);
  neverPops(scene, {0, -0.01, 0}, 0.05, 4);
}

// A narrow groove: the proxy comes to rest at its bottom, and comes out again.
TEST(Proxy, ComesToRestInAGroove) {
  TouchScene scene;
  for (const double side : {1.0, -1.0}) {
    const Vec3 low1{0, 0, -0.1}, low2{0, 0, 0.1}, high1{0.02 * side, 0.05, -0.1}, high2{0.02 * side, 0.05, 0.1};
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
      auto facet = *facetOf(a, b, c, false);
      if (facet.normal.x * side > 0) facet = *facetOf(a, c, b, false);
      scene.facets.push_back(facet);
    };
    add(low1, low2, high1);
    add(low2, high2, high1);
  }
  Proxy proxy;
  proxy.reset({0, 0.04, 0});
  for (int k = 0; k < 100; ++k) proxy.follow({0.004, 0.04 - 0.0005 * k, 0.0001 * k}, scene, 0);
  const auto bottom = proxy.follow({0.002, -0.02, 0.01}, scene, 0);
  EXPECT_TRUE(bottom.touching);
  EXPECT_NEAR(bottom.proxy.x, 0, 1e-4);
  EXPECT_NEAR(bottom.proxy.y, 0, 2e-4);
  EXPECT_NEAR(bottom.proxy.z, 0.01, 1e-4);
  EXPECT_FALSE(proxy.follow({0, 0.04, 0}, scene, 0).touching);
}

TEST(Proxy, FrictionHoldsItWithinTheCone) {
  TouchScene scene = floorScene();
  Proxy proxy;
  proxy.follow({0, 0.01, 0}, scene, 0.3);
  proxy.follow({0, -0.01, 0}, scene, 0.3);
  const auto sticks = proxy.follow({0.0029, -0.01, 0}, scene, 0.3);
  EXPECT_NEAR(sticks.proxy.x, 0, 1e-6);
  const auto slips = proxy.follow({0.0131, -0.01, 0}, scene, 0.3);
  EXPECT_NEAR(slips.proxy.x, 0.0131 - 0.3 * 0.01, 2e-5);
}

}  // namespace
}  // namespace karinui
