#pragma once
// Elastics along inner lines, as for shirring.
#include "karinui/pattern/allowance.h"

namespace karinui {

// The pattern as it is laid: an inner line that an elastic is sewn to is sewn to itself, so that nodes of the lattice
// lie along it; nothing is tied by that. The ids of these seams are no document's. Pure; any thread.
Pattern withElasticLines(Pattern pattern, const Allowances& finish);

}  // namespace karinui
