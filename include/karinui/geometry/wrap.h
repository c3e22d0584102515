#pragma once
// A watertight skin over a surface with holes: the place where a grid of cells turns from outside to inside. Metres.
#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// The result is closed, two-manifold, outward and free of crossings, whatever the input; details smaller than a cell
// are lost, holes are closed by smooth caps. Without surface, or with cells too small for its size: refused.
Result<TriangleMesh> wrapped(const TriangleMesh& surface, double cell, Workers& workers, const Token& token);

}  // namespace karinui
