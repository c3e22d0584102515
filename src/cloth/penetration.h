#pragma once
// Penetration of the colliders' exact surfaces, which are finer than what the steps sample: how deep it is, and a last
// correction of cloth at rest.
#include "cloth/level_solver.h"

namespace karinui {

// Lifts what stands less than `clearance` (metres) above a surface, points within faces included, and every face that a
// surface intersects, as far as cloth does not pass through cloth. Returns how many faces a surface then still
// intersects.
std::size_t liftOffColliders(LevelSolver& solver, const ColliderList& colliders, double clearance, Workers& workers);
struct Penetration {
  double depth = 0;  // metres below a surface
  const ClothPiece* piece = nullptr;
  Vec3 place;
};
// The deepest of cloth of live pieces. `piece` is of the cloth; null: none stands below.
Penetration deepestPenetration(const Cloth& cloth, const ColliderList& colliders, std::span<const Vec3> x,
                               Workers& workers);

}  // namespace karinui
