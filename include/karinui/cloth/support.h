#pragma once
// What holds resting cloth up: how hard the world presses on each of its places. At rest all forces balance, so what
// the body, a pin or other cloth gives is what the cloth's own stretch, shear, bending and weight leave over. A body
// is pressed as hard as it presses back. Pure; any thread, with its own workers.
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// Newtons per square metre of cloth as it was cut, per cloth node, as a vector: on resting cloth that lies on
// something, out of it. Nodes sewn together share theirs; nodes that do not move have none. Single nodes are as uneven
// as the cloth's last moves: take means over a patch.
std::vector<Vec3> supportOf(const Cloth& cloth, const ClothState& state, Vec3 gravity, Workers& workers);
// The area each node stands for, square metres.
std::vector<double> areasOf(const Cloth& cloth);

}  // namespace karinui
