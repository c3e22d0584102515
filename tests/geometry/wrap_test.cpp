#include "karinui/geometry/wrap.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace karinui {
namespace {

TEST(Wrap, ClosesABallWithAHole) {
  TriangleMesh m = test::ball({0.3, 0.1, -0.2}, 0.2, 5);
  std::erase_if(m.faces, [&](const Triangle& f) { return m.points[f[0]].y > 0.1 + 0.17; });
  ASSERT_FALSE(inspect(m).closed());
  Workers workers(2);
  const auto skin = wrapped(m, 0.01, workers, Token{});
  ASSERT_TRUE(skin);
  const MeshReport r = inspect(*skin);
  EXPECT_TRUE(r.closed());
  EXPECT_TRUE(r.outward);
  EXPECT_EQ(r.shells, 1u);
  EXPECT_EQ(r.selfCrossings, 0u);
  EXPECT_NEAR(volume(*skin), 4.0 / 3 * 3.14159265 * 0.008, 0.0015);
  for (const Vec3& p : skin->points) {
    if (p.y < 0.1 + 0.15) {
      EXPECT_NEAR(distance(p, {0.3, 0.1, -0.2}), 0.2, 0.002);
    }
  }
}

TEST(Wrap, GivesAManifoldForAnySoup) {
  test::Numbers numbers(5);
  for (int n = 0; n < 3; ++n) {
    TriangleMesh m;
    for (int f = 0; f < 60; ++f) test::append(m, test::ball(numbers.point(0.2), numbers.between(0.02, 0.1), 1));
    m.faces.resize(m.faces.size() - 37);
    Workers workers(2);
    const auto skin = wrapped(m, 0.02, workers, Token{});
    ASSERT_TRUE(skin);
    const MeshReport r = inspect(*skin);
    EXPECT_TRUE(r.closed()) << r.openEdges << " " << r.nonManifoldEdges << " " << r.flippedEdges;
    EXPECT_EQ(r.selfCrossings, 0u);
    EXPECT_TRUE(r.outward);
  }
}

TEST(Wrap, RefusesWhatItCannotWrap) {
  Workers workers(1);
  EXPECT_FALSE(wrapped({}, 0.01, workers, Token{}));
  EXPECT_FALSE(wrapped(test::ball({}, 1, 2), 1e-4, workers, Token{}));
  EXPECT_FALSE(wrapped(test::ball({}, 1, 2), 0, workers, Token{}));
}

}  // namespace
}  // namespace karinui
