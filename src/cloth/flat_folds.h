#pragma once
// What a detail transfer would let intersect itself: where a fold of the coarse level closes, the detail of one side
// reaches into that of the other.
#include <vector>

#include "cloth/detail_transfer.h"

namespace karinui {

// Where the fine nodes are when the coarse ones are at `places`, with the turns of `detail` as they are. Fine faces
// that would intersect others lie flat on the coarse ones, which intersect less; where those do, too, the detail is
// kept.
std::vector<Vec3> withFlatFolds(const DetailTransfer& detail, const Cloth& fine, const Cloth& coarse,
                                std::span<const Vec3> places, Workers& workers);

}  // namespace karinui
