#include "design/operations/seam_parts.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

// A part of a seam, by the share of its length along side a.
struct Share {
  double from = 0, to = 1;
};

// Where each span of a side lies in it.
std::vector<Share> sharesOf(const Pattern& pattern, const std::vector<EdgeSpan>& side) {
  const double all = length(pattern, side);
  std::vector<Share> shares;
  double at = 0;
  for (const EdgeSpan& span : side) {
    const double next = at + length(pattern, {span}) / all;
    shares.push_back({at, next});
    at = next;
  }
  return shares;
}

// What stays of a side, in one part for each run of pieces that stay.
std::vector<Share> staying(const Pattern& pattern, const std::vector<EdgeSpan>& side, const OnSpan& gone,
                           bool backwards) {
  const std::vector<Share> shares = sharesOf(pattern, side);
  std::vector<Share> parts;
  for (std::size_t k = 0; k < side.size(); ++k) {
    if (gone(side[k])) continue;
    if (k > 0 && !gone(side[k - 1]))
      parts.back().to = shares[k].to;
    else
      parts.push_back(shares[k]);
  }
  if (!backwards) return parts;
  for (Share& part : parts) part = {1 - part.to, 1 - part.from};
  std::reverse(parts.begin(), parts.end());
  return parts;
}

std::vector<EdgeSpan> partOf(const Pattern& pattern, const std::vector<EdgeSpan>& side, Share part, bool backwards) {
  if (backwards) part = {1 - part.to, 1 - part.from};
  const std::vector<Share> shares = sharesOf(pattern, side);
  std::vector<EdgeSpan> spans;
  constexpr double kNone = 1e-9;
  for (std::size_t k = 0; k < side.size(); ++k) {
    const Share& own = shares[k];
    const double from = std::max(part.from, own.from), to = std::min(part.to, own.to);
    if (to - from < kNone) continue;
    const auto along = [&](double at) {
      const double share = (at - own.from) / (own.to - own.from);
      return std::abs(share) < kNone       ? side[k].from
             : std::abs(share - 1) < kNone ? side[k].to
                                           : std::lerp(side[k].from, side[k].to, share);
    };
    EdgeSpan span = side[k];
    span.from = along(from), span.to = along(to);
    spans.push_back(std::move(span));
  }
  return spans;
}

}  // namespace

std::vector<SeamPart> partsWithout(const Pattern& pattern, const Seam& seam, const OnSpan& gone) {
  constexpr double kShortest = 0.002;  // metres
  const double all = length(pattern, seam.a);
  std::vector<SeamPart> parts;
  for (const Share& a : staying(pattern, seam.a, gone, false))
    for (const Share& b : staying(pattern, seam.b, gone, seam.reversed)) {
      const Share both{std::max(a.from, b.from), std::min(a.to, b.to)};
      if ((both.to - both.from) * all < kShortest) continue;
      Seam part = seam;
      part.a = partOf(pattern, seam.a, both, false), part.b = partOf(pattern, seam.b, both, seam.reversed);
      parts.push_back({std::move(part), both.to - both.from});
    }
  return parts;
}

void keepParts(const Document& before, Document& after, const OnSpan& gone, std::uint32_t& minted) {
  for (const auto& [id, seam] : before.pattern.seams) {
    if (!touches(seam, gone)) continue;
    const auto ease = before.eases.find(id);
    bool first = true;
    for (SeamPart& part : partsWithout(before.pattern, seam, gone)) {
      if (!first) part.seam.id = mint<SeamId>(before, minted++), part.seam.name.clear();
      if (ease != before.eases.end()) after.eases[part.seam.id] = ease->second * part.share;
      after.pattern.seams[part.seam.id] = std::move(part.seam);
      first = false;
    }
  }
}

}  // namespace karinui
