#pragma once
// The last touch at rest: cloth is taken off the body's true surface, which is finer than what the steps ask.
#include "cloth/level_solver.h"

namespace karinui {

// Lifts what stands less than `clearance` (metres) above the true surface, places within faces included, and every face
// that a point or side of the body passes through, as far as cloth does not pass through cloth.
void liftOff(LevelSolver& solver, const ColliderList& colliders, double clearance, Workers& workers);
// The deepest the cloth of live pieces stands below the true surface (>= 0), metres.
double deepest(const Cloth& cloth, const ColliderList& colliders, std::span<const Vec3> x, Workers& workers);

}  // namespace karinui
