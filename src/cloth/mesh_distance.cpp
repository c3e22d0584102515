#include "cloth/mesh_distance.h"

#include "karinui/geometry/triangle_intersection.h"

namespace karinui {

Collider::Sample meshSample(const Body& body, Vec3 place) {
  const DistanceField::Sample sample = body.field().sample(place);
  const double steep = length(sample.gradient);
  const Collider::Sample rough{sample.distance, steep > 1e-9 ? sample.gradient * (1 / steep) : Vec3{0, 1, 0}};
  if (rough.distance > 3 * body.field().cell()) return rough;
  const auto near = body.bvh().nearest(place);
  if (!near) return rough;
  const double distance = body.bvh().signedDistance(place);
  // On the surface itself the vector to the closest point has no direction; the face has.
  const Vec3 out = place - near->point;
  const double away = length(out);
  const Vec3 normal = away > 1e-7 ? out * ((distance < 0 ? -1 : 1) / away) : faceNormal(body.mesh(), near->place.face);
  return {distance, length(normal) > 0 ? normal : rough.normal};
}

Vec3 intersectionNormalOf(const TriangleMesh& mesh, const Bvh& tree, const std::array<Vec3, 3>& face) {
  Box box;
  for (Vec3 p : face) box.include(p);
  const std::array<NanoPoint, 3> corners{toNano(face[0]), toNano(face[1]), toNano(face[2])};
  Vec3 out;
  tree.touching(box, [&](std::uint32_t g) {
    const Triangle& t = mesh.faces[g];
    if (trianglesIntersect(corners, {toNano(mesh.points[t[0]]), toNano(mesh.points[t[1]]), toNano(mesh.points[t[2]])}))
      out += faceNormal(mesh, g);
  });
  return squaredLength(out) > 0 ? normalized(out) : out;
}

Vec3 meshIntersectionNormal(const Body& body, const std::array<Vec3, 3>& face) {
  const Vec3 middle = (face[0] + face[1] + face[2]) * (1.0 / 3);
  double reach = 0;
  for (Vec3 p : face) reach = std::fmax(reach, distance(p, middle));
  if (body.field().distance(middle) > reach + body.field().cell()) return {};
  return intersectionNormalOf(body.mesh(), body.bvh(), face);
}

}  // namespace karinui
