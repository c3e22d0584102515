#pragma once
// How much cloth is stretched: |l/L - 1| over the warp and weft edges of the lattices' whole cells.
#include "karinui/cloth/cloth.h"
#include "karinui/cloth/settle_report.h"

namespace karinui {

StrainReport strainOf(const Cloth& cloth, std::span<const Vec3> x);

}  // namespace karinui
