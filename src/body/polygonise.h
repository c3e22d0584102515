#pragma once
// A closed mesh from the field: one point per cell the surface passes through, a quad around each crossed grid edge,
// then points slid along the surface until they lie evenly. Two-manifold by construction: cells in which the surface
// would touch itself are filled first.
#include "body/figure_field.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

TriangleMesh polygonise(const FieldGrid& half, int rounds, Workers& workers);

}  // namespace karinui
