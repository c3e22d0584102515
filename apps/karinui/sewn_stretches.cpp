#include "sewn_stretches.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui::app {

std::vector<SewnStretch> sewnStretches(const Document& document, const Piece& piece) {
  const Pattern& pattern = document.pattern;
  std::vector<SewnStretch> all;
  for (const auto& [id, seam] : pattern.seams) {
    const SeamSides sides(pattern, seam);
    const std::vector<double> breaks = sides.breaks();
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      // By two places well within: at a break itself a walk is on either of two edges.
      const double from = std::lerp(breaks[k], breaks[k + 1], 0.25), to = std::lerp(breaks[k], breaks[k + 1], 0.75);
      const auto span = [&](const SeamSide& side) {
        const SeamPlace one = side.at(from), other = side.at(to);
        const double beyond = (other.fraction - one.fraction) / 2;
        const double begins = one.fraction - beyond, ends = other.fraction + beyond;
        const auto whole = [](double share) {
          return std::fabs(share - std::round(share)) < 1e-6 ? std::round(share) : share;
        };
        return EdgeSpan{one.piece, one.edge, whole(std::min(begins, ends)), whole(std::max(begins, ends))};
      };
      const EdgeSpan a = span(sides.a), b = span(sides.b);
      for (const bool first : {true, false}) {
        const EdgeSpan &own = first ? a : b, &other = first ? b : a;
        const Curve* curve = findCurve(piece, own.edge);
        if (own.piece == piece.id && curve) all.push_back({own, other, id, (own.to - own.from) * curve->length()});
      }
    }
  }
  const auto place = [&](const SewnStretch& one) {
    return piece.outline.find(one.own.edge).value_or(piece.outline.edges.size());
  };
  std::stable_sort(all.begin(), all.end(), [&](const SewnStretch& a, const SewnStretch& b) {
    return std::pair(place(a), a.own.from) < std::pair(place(b), b.own.from);
  });
  return all;
}

std::string stretchNamed(const EdgeSpan& span) {
  if (span.from == 0 && span.to == 1) return span.edge;
  return span.edge + "@" + fixed(span.from, 3) + ":" + fixed(span.to, 3);
}

}  // namespace karinui::app
