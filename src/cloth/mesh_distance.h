#pragma once
// The exact distance from the body's mesh itself, the same for every collider made of a body. Costly.
#include "karinui/cloth/collider.h"

namespace karinui {

// Beyond three cells of the body's field the field's distance is taken.
Collider::Sample meshSample(const Body& body, Vec3 place);
Vec3 meshIntersectionNormal(const Body& body, const std::array<Vec3, 3>& face);  // as Collider::intersectionNormal
Vec3 intersectionNormalOf(const TriangleMesh& mesh, const Bvh& tree, const std::array<Vec3, 3>& face);

}  // namespace karinui
