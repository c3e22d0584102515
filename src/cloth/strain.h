#pragma once
// How much cloth is stretched: |l/L - 1| over the warp and weft edges of the lattices' whole cells.
#include "karinui/cloth/cloth.h"
#include "karinui/cloth/settle_report.h"

namespace karinui {

StrainReport strainOf(const Cloth& cloth, std::span<const Vec3> x);

struct DrawnOut {
  const ClothPiece* piece = nullptr;  // of the cloth; null: it has no thread
  double times = 0;                   // its length at rest
  Vec3 place;                         // of its middle
};
DrawnOut mostDrawnOut(const Cloth& cloth, std::span<const Vec3> x);  // the thread that is

}  // namespace karinui
