#pragma once
// What is left of seams where a part of what they join goes.
#include <algorithm>
#include <functional>
#include <optional>
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

// A stretch of a seam, by the share of its length along side a.
struct SeamStretch {
  double from = 0, to = 1;
};
std::vector<SeamPart> partsBeside(const Pattern& pattern, const Seam& seam, SeamStretch gone);
SeamPart partWithin(const Pattern& pattern, const Seam& seam, SeamStretch kept);
// What of a seam's side `other` covers, from its first place to its last. Nothing where they have nothing in common.
std::optional<SeamStretch> coveredBy(const Pattern& pattern, const Seam& seam, bool onA,
                                     const std::vector<EdgeSpan>& other);

// Puts the parts in the place of a seam of `before`: the first keeps its id and name, others get new ones, `minted`
// counting them; a declared ease is shared out.
void replaceByParts(const Document& before, Document& after, SeamId id, std::vector<SeamPart> parts,
                    std::uint32_t& minted);

// Puts into `after` what stays of the seams that touch what is gone.
void keepParts(const Document& before, Document& after, const OnSpan& gone, std::uint32_t& minted);

}  // namespace karinui
