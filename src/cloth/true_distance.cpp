#include "cloth/true_distance.h"

namespace karinui {

Collider::Contact trueContact(const Body& body, Vec3 place) {
  const DistanceField::Sample sample = body.field().sample(place);
  const double steep = length(sample.gradient);
  const Collider::Contact rough{sample.distance, steep > 1e-9 ? sample.gradient * (1 / steep) : Vec3{0, 1, 0}};
  if (rough.distance > 3 * body.field().cell()) return rough;
  const auto near = body.bvh().nearest(place);
  if (!near) return rough;
  const double distance = body.bvh().signedDistance(place);
  // Right on the surface the way to the nearest point says nothing; the face does.
  const Vec3 out = place - near->point;
  const double away = length(out);
  const Vec3 normal = away > 1e-7 ? out * ((distance < 0 ? -1 : 1) / away) : faceNormal(body.mesh(), near->place.face);
  return {distance, length(normal) > 0 ? normal : rough.normal};
}

}  // namespace karinui
