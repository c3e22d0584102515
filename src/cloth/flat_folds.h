#pragma once
// Folds that would intersect themselves, or do, lose their detail.
#include <vector>

#include "cloth/detail_transfer.h"

namespace karinui {

// Where the fine nodes are when the coarse ones are at `places`, with the turns of `detail` as they are. As a fold of
// the coarse level closes, the detail of one side reaches into that of the other: fine faces that would intersect
// others lie flat on the coarse ones, which intersect less. Where those do, too, the detail is kept, since it tells
// which layer is above.
std::vector<Vec3> withFlatFolds(const DetailTransfer& detail, const Cloth& fine, const Cloth& coarse,
                                std::span<const Vec3> places, Workers& workers);

// The places of a level, those of faces that intersect others, and beside them, each amid its neighbours: a knot in one
// sheet is open then. May leave cloth in a body.
std::vector<Vec3> withKnotsSmoothed(const Cloth& cloth, std::vector<Vec3> places, Workers& workers);

}  // namespace karinui
