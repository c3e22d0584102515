#pragma once
// Penetration of the colliders' exact surfaces, which are finer than what the steps sample: how deep it is, and a last
// correction of cloth at rest.
#include "cloth/level_solver.h"

namespace karinui {

// Lifts what stands less than `clearance` (metres) above a surface, points within faces included, and every face that a
// surface intersects, as far as cloth does not pass through cloth. Returns how many faces a surface then still
// intersects.
std::size_t liftOffColliders(LevelSolver& solver, const ColliderList& colliders, double clearance, Workers& workers);
// The deepest that cloth of live pieces stands below a surface (>= 0), metres.
double deepestPenetration(const Cloth& cloth, const ColliderList& colliders, std::span<const Vec3> x, Workers& workers);

}  // namespace karinui
