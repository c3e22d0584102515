#include "karinui/scene/scene_frame.h"

namespace karinui {

bool drawable(Vec3 p) {
  return finite(p) && std::fabs(p.x) <= kStudioReach && std::fabs(p.y) <= kStudioReach &&
         std::fabs(p.z) <= kStudioReach;
}

namespace {

void include(Box& box, const std::vector<Vec3>& points) {
  for (const Vec3 p : points)
    if (drawable(p)) box.include(p);
}

}  // namespace

Box extent(const SceneFrame& frame) {
  Box box;
  for (const SceneBody& body : frame.bodies) include(box, body.mesh.points);
  for (const SceneCloth& cloth : frame.cloths) include(box, cloth.mesh.points);
  for (const SceneLine& line : frame.lines) include(box, line.points);
  return box;
}

}  // namespace karinui
