#include "sewn_stretches.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui::app {

namespace {

constexpr double kSliver = 0.0005;  // metres: what is less lies between corners that are meant to meet

// Where a seam's sides change from edge to edge, without those that are a sliver away from the one before or the end.
std::vector<double> breaksOf(const Pattern& pattern, const Seam& seam) {
  const double most = kSliver / std::fmax(1e-9, std::fmin(length(pattern, seam.a), length(pattern, seam.b)));
  std::vector<double> breaks;
  for (const double at : SeamSides(pattern, seam).breaks())
    if (breaks.empty() || at - breaks.back() > most) breaks.push_back(at);
  while (breaks.size() > 1 && 1 - breaks.back() < most) breaks.pop_back();
  breaks.push_back(1);
  return breaks;
}

}  // namespace

std::vector<SewnStretch> sewnStretches(const Document& document, const Piece& piece) {
  const Pattern& pattern = document.pattern;
  std::vector<SewnStretch> all;
  for (const auto& [id, seam] : pattern.seams) {
    const SeamSides sides(pattern, seam);
    const std::vector<double> breaks = breaksOf(pattern, seam);
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      // By two places well within: at a break itself a walk is on either of two edges.
      const double from = std::lerp(breaks[k], breaks[k + 1], 0.25), to = std::lerp(breaks[k], breaks[k + 1], 0.75);
      const auto span = [&](const SeamSide& side) {
        const SeamPlace one = side.at(from), other = side.at(to);
        const double beyond = (other.fraction - one.fraction) / 2;
        const double begins = one.fraction - beyond, ends = other.fraction + beyond;
        const Curve* on = curveOf(pattern, one.piece, one.edge);
        const double near = on ? kSliver / std::fmax(kSliver, on->length()) : 1e-6;
        const auto whole = [&](double share) {
          return std::fabs(share - std::round(share)) < near ? std::round(share) : std::clamp(share, 0.0, 1.0);
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
