#include "design/operations/seam_parts.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

using Share = SeamStretch;

constexpr double kShortest = 0.002;  // metres: shorter parts are left out

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

void addPart(const Pattern& pattern, const Seam& seam, Share share, std::vector<SeamPart>& parts) {
  if ((share.to - share.from) * length(pattern, seam.a) < kShortest) return;
  parts.push_back(partWithin(pattern, seam, share));
}

}  // namespace

std::vector<SeamPart> partsWithout(const Pattern& pattern, const Seam& seam, const OnSpan& gone) {
  std::vector<SeamPart> parts;
  for (const Share& a : staying(pattern, seam.a, gone, false))
    for (const Share& b : staying(pattern, seam.b, gone, seam.reversed))
      addPart(pattern, seam, {std::max(a.from, b.from), std::min(a.to, b.to)}, parts);
  return parts;
}

std::vector<SeamPart> partsBeside(const Pattern& pattern, const Seam& seam, SeamStretch gone) {
  std::vector<SeamPart> parts;
  addPart(pattern, seam, {0, gone.from}, parts);
  addPart(pattern, seam, {gone.to, 1}, parts);
  return parts;
}

SeamPart partWithin(const Pattern& pattern, const Seam& seam, SeamStretch kept) {
  Seam part = seam;
  part.a = partOf(pattern, seam.a, kept, false), part.b = partOf(pattern, seam.b, kept, seam.reversed);
  return {std::move(part), kept.to - kept.from};
}

std::optional<SeamStretch> coveredBy(const Pattern& pattern, const Seam& seam, bool onA,
                                     const std::vector<EdgeSpan>& other) {
  constexpr double kNone = 1e-6;  // of an edge
  const std::vector<EdgeSpan>& side = onA ? seam.a : seam.b;
  const std::vector<Share> shares = sharesOf(pattern, side);
  std::optional<Share> covered;
  for (std::size_t k = 0; k < side.size(); ++k)
    for (const EdgeSpan& span : other) {
      const EdgeSpan& own = side[k];
      const double from = std::max(own.from, span.from), to = std::min(own.to, span.to);
      if (own.piece != span.piece || own.edge != span.edge || to - from < kNone) continue;
      const auto along = [&](double at) {
        return std::lerp(shares[k].from, shares[k].to, (at - own.from) / (own.to - own.from));
      };
      if (!covered) covered = Share{along(from), along(to)};
      covered->from = std::min(covered->from, along(from)), covered->to = std::max(covered->to, along(to));
    }
  if (covered && !onA && seam.reversed) covered = Share{1 - covered->to, 1 - covered->from};
  return covered;
}

void replaceByParts(const Document& before, Document& after, SeamId id, std::vector<SeamPart> parts,
                    std::uint32_t& minted) {
  const auto ease = before.eases.find(id);
  after.pattern.seams.erase(id);
  bool first = true;
  for (SeamPart& part : parts) {
    if (!first) part.seam.id = mint<SeamId>(before, minted++), part.seam.name.clear();
    if (ease != before.eases.end()) after.eases[part.seam.id] = ease->second * part.share;
    after.pattern.seams[part.seam.id] = std::move(part.seam);
    first = false;
  }
}

void keepParts(const Document& before, Document& after, const OnSpan& gone, std::uint32_t& minted) {
  for (const auto& [id, seam] : before.pattern.seams)
    if (touches(seam, gone)) replaceByParts(before, after, id, partsWithout(before.pattern, seam, gone), minted);
}

}  // namespace karinui
