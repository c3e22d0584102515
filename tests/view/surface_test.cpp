#include "view/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "geometry/shapes.h"

namespace karinui {
namespace {

bool same(const Surface& a, const Surface& b) {
  return a.corners == b.corners && a.vertices.size() == b.vertices.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(SurfaceVertex)) == 0;
}

// A body on its way is drawn where it is, and nearly as well; when it stands nothing of the way is left.
TEST(KeptMesh, GoesAlongRoughlyAndIsExactWhenItStands) {
  SceneBody body;
  body.mesh = test::ball({0, 1, 0}, 0.2, 5);
  KeptMesh kept;
  Surface start;
  kept.add(start, body.mesh, {}, body.colour);
  for (Vec3& p : body.mesh.points) p = turnAbout({0, 0, 1}, 2 * (p.y - 1))(p) + Vec3{0.3, 0, 0};
  Surface rough, exact, fresh;
  kept.add(rough, body.mesh, {}, body.colour, true);
  addMesh(fresh, body.mesh, {}, body.colour);
  ASSERT_EQ(rough.vertices.size(), fresh.vertices.size());
  double off = 0;
  for (std::size_t i = 0; i < fresh.vertices.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(rough.vertices[i].place[k], fresh.vertices[i].place[k]);
      off = std::max(off, std::fabs(static_cast<double>(rough.vertices[i].normal[k]) - fresh.vertices[i].normal[k]));
    }
  EXPECT_LT(off, 0.1);
  EXPECT_FALSE(same(rough, fresh));
  kept.add(exact, body.mesh, {}, body.colour);
  EXPECT_TRUE(same(exact, fresh));
}

}  // namespace
}  // namespace karinui
