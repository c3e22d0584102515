#include "karinui/pattern/pockets.h"

#include <algorithm>
#include <optional>

namespace karinui {

namespace {

using PocketRun = std::vector<EdgeSpan>;

bool allOf(PieceId piece, const PocketRun& side) {
  return std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) { return span.piece == piece; });
}

bool onInnerLines(const Pattern& pattern, const PocketRun& side) {
  return std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
    const auto piece = pattern.pieces.find(span.piece);
    return piece != pattern.pieces.end() && !findEdge(*piece->second, span.edge);
  });
}

bool holdsAll(const PocketRun& run, const PocketRun& part) {
  constexpr double kSame = 1e-6;  // of an edge
  return std::all_of(part.begin(), part.end(), [&](const EdgeSpan& own) {
    return std::any_of(run.begin(), run.end(), [&](const EdgeSpan& span) {
      return span.piece == own.piece && span.edge == own.edge && span.from <= own.from + kSame &&
             span.to >= own.to - kSame;
    });
  });
}

}  // namespace

std::vector<SewnPocket> pocketsOf(const Pattern& pattern) {
  struct Caught {
    SeamId id;
    const Seam* seam;
    PieceId bag;
  };
  std::vector<Caught> pleats;
  std::vector<const Seam*> rounds, plain;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.a.empty() || seam.b.empty()) continue;
    const PieceId a = seam.a.front().piece, b = seam.b.front().piece;
    if (seam.tie == Seam::Tie::Pleat) {
      if (a != b && allOf(b, seam.b)) pleats.push_back({id, &seam, b});
      continue;
    }
    plain.push_back(&seam);
    if (!seam.reversed && a != b && allOf(a, seam.a) && allOf(b, seam.b)) rounds.push_back(&seam);
  }
  std::vector<SewnPocket> pockets;
  for (const Seam* round : rounds) {
    std::optional<SewnPocket> longest;  // the seam beside an opening lies over the bags, too
    double most = 0;
    for (const bool swapped : {false, true}) {
      PieceId turned = round->a.front().piece, other = round->b.front().piece;
      if (swapped) std::swap(turned, other);
      for (const Caught& first : pleats) {
        if (first.bag != turned || first.seam->reversed) continue;
        for (const Seam* opening : plain) {
          if (opening == round) continue;
          const bool onA = holdsAll(first.seam->a, opening->a);
          if (!onA && !holdsAll(first.seam->a, opening->b)) continue;
          const PocketRun& beyond = onA ? opening->b : opening->a;
          SewnPocket pocket{opening->id, {first.id}, round->id};
          const auto goesOn = std::find_if(pleats.begin(), pleats.end(), [&](const Caught& second) {
            return second.bag == other && holdsAll(second.seam->a, beyond);
          });
          if (goesOn != pleats.end())
            pocket.caught.push_back(goesOn->id);
          else if (!allOf(other, beyond) || !onInnerLines(pattern, beyond))
            continue;
          if (const double own = length(pattern, opening->a); own > most) most = own, longest = std::move(pocket);
        }
      }
    }
    if (longest) pockets.push_back(*std::move(longest));
  }
  return pockets;
}

std::vector<SeamId> bagsOnLines(const Pattern& pattern) {
  std::vector<SeamId> bags;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie != Seam::Tie::Pleat || seam.reversed || seam.a.empty() || seam.b.empty()) continue;
    const PieceId outer = seam.a.front().piece, bag = seam.b.front().piece;
    if (outer != bag && onInnerLines(pattern, seam.a) &&
        pattern.pieces.at(bag)->layer < pattern.pieces.at(outer)->layer)
      bags.push_back(id);
  }
  return bags;
}

}  // namespace karinui
