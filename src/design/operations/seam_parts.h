#pragma once
// What is left of seams where a part of what they join goes.
#include <algorithm>
#include <functional>
#include <vector>

#include "design/operations/operations.h"

namespace karinui {

using OnSpan = std::function<bool(const EdgeSpan&)>;

template <class Sewn>  // a Seam or a Fastening
bool touches(const Sewn& sewn, const OnSpan& which) {
  return std::any_of(sewn.a.begin(), sewn.a.end(), which) || std::any_of(sewn.b.begin(), sewn.b.end(), which);
}

// The parts of a seam where both sides stay, in its order.
struct SeamPart {
  Seam seam;
  double share;  // of its length
};
std::vector<SeamPart> partsWithout(const Pattern& pattern, const Seam& seam, const OnSpan& gone);

// Puts into `after` what stays of the seams that touch what is gone: the first part keeps the seam's id and name,
// others get new ones, `minted` counting them; a declared ease is shared out.
void keepParts(const Document& before, Document& after, const OnSpan& gone, std::uint32_t& minted);

}  // namespace karinui
