#pragma once
// The drape tester (Cusick): a disc of 30 cm lies on a support of 18 cm; what stands out hangs in folds, and its shadow
// is measured. A cloth has no single drape, so the disc is laid on several times, each time another hair uneven.
#include "bench/workload.h"
#include "karinui/cloth/drape_disc.h"

namespace karinui::bench {

inline constexpr double kDisc = kDrapeDisc, kSupport = kDrapeSupport;

struct Draped {
  double coefficient = 0;  // percent of the free ring that the shadow covers: 0 hangs, 100 stands out
  int folds = 0;           // the rim's strongest wave
  ClothLevel disc;
  SettleReport report;
};
// About so many vertices in the whole disc; 0: 2,800 (5 mm apart). `seed` makes the unevenness, some 5 mm at the rim.
Result<Draped> cusick(const Fabric& fabric, std::size_t vertices, unsigned seed, Workers& workers, const Token& token);

// The area of the shadow the cloth throws downwards, m2.
double shadowOf(const Cloth& cloth, const ClothState& state);

}  // namespace karinui::bench
