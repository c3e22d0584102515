#include "body/anthropometry/survey.h"

namespace karinui {

Anthropometry anthropometryOf(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return {};
  Interval tall, wide;
  for (const Vec3& p : mesh.points) tall.include(p.y), wide.include(p.x);
  const double stature = tall.high - tall.low;
  if (!(stature > 0.3 && stature < 3)) return {};  // metres
  Survey body{.mesh = mesh, .slices = MeshSlices(mesh, tall.low, tall.high)};
  body.floor = tall.low;
  body.stature = stature;
  body.middle = (wide.low + wide.high) / 2;
  body.set("height", stature);
  if (findCrotch(body) && findArmpit(body)) {
    measureTrunk(body);
    measureLegs(body);
    for (const int side : {0, 1}) measureArm(body, side);
    measureNeck(body);
    measureShoulders(body);
    measureWaistLengths(body);
  }
  return std::move(body.found);
}

}  // namespace karinui
