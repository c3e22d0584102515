#include "karinui/pattern/seam_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace karinui {
namespace {

constexpr double kSameFraction = 1e-6;  // of a side's length: fractions nearer than this are one place
constexpr double kSameSpot = 1e-4;      // metres along an edge

}  // namespace

const Edge* edgeOf(const Pattern& pattern, PieceId piece, std::string_view edge) {
  const auto found = pattern.pieces.find(piece);
  return found == pattern.pieces.end() ? nullptr : findEdge(*found->second, edge);
}

const Curve* curveOf(const Pattern& pattern, PieceId piece, std::string_view name) {
  const auto found = pattern.pieces.find(piece);
  return found == pattern.pieces.end() ? nullptr : findCurve(*found->second, name);
}

SeamSide::SeamSide(const Pattern& pattern, const std::vector<EdgeSpan>& spans, bool against) : against_(against) {
  double along = 0;
  for (const EdgeSpan& span : spans) {
    const Curve* curve = curveOf(pattern, span.piece, span.edge);
    if (!curve || !(span.to > span.from)) continue;
    spans_.push_back(span);
    end_.push_back(along += curve->length() * (span.to - span.from));
  }
}

std::vector<double> SeamSide::breaks() const {
  if (end_.empty()) return {};
  std::vector<double> out{0};
  for (const double end : end_) out.push_back(end / length());
  out.back() = 1;
  if (against_) {
    std::reverse(out.begin(), out.end());
    for (double& fraction : out) fraction = 1 - fraction;
  }
  return out;
}

SeamPlace SeamSide::at(double fraction) const {
  if (spans_.empty()) return {};
  const double along = std::clamp(against_ ? 1 - fraction : fraction, 0.0, 1.0) * length();
  std::size_t i = 0;
  while (i + 1 < spans_.size() && along > end_[i] + (against_ ? -kSameFraction : kSameFraction) * length()) ++i;
  const double start = i == 0 ? 0 : end_[i - 1];
  const double within = std::clamp((along - start) / (end_[i] - start), 0.0, 1.0);
  return {spans_[i].piece, spans_[i].edge, spans_[i].from + within * (spans_[i].to - spans_[i].from)};
}

double SeamSide::fractionOf(std::size_t span, double edgeFraction) const {
  const double start = span == 0 ? 0 : end_[span - 1];
  const double within = (edgeFraction - spans_[span].from) / (spans_[span].to - spans_[span].from);
  const double own = (start + within * (end_[span] - start)) / length();
  return against_ ? 1 - own : own;
}

std::vector<double> SeamSides::breaks() const {
  std::vector<double> all = a.breaks();
  for (const double fraction : b.breaks()) all.push_back(fraction);
  std::sort(all.begin(), all.end());
  std::vector<double> out;
  for (const double fraction : all)
    if (out.empty() || fraction - out.back() > kSameFraction) out.push_back(fraction);
  if (!out.empty()) out.back() = 1;
  return out;
}

std::vector<SeamPlace> sewnTo(const Pattern& pattern, const SeamPlace& place) {
  std::vector<SeamPlace> all{place};
  const auto known = [&](const SeamPlace& there, double whole) {
    return std::any_of(all.begin(), all.end(), [&](const SeamPlace& one) {
      return one.piece == there.piece && one.edge == there.edge &&
             std::abs(one.fraction - there.fraction) * whole < kSameSpot;
    });
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const auto& [id, seam] : pattern.seams) {
      const SeamPlace from = all[i];
      const SeamSides sides(pattern, seam);
      for (const auto& [own, other] : {std::pair(&sides.a, &sides.b), std::pair(&sides.b, &sides.a)})
        for (std::size_t k = 0; k < own->spans().size(); ++k) {
          const EdgeSpan& span = own->spans()[k];
          if (span.piece != from.piece || span.edge != from.edge || other->spans().empty()) continue;
          if (from.fraction < span.from - kSameFraction || from.fraction > span.to + kSameFraction) continue;
          const SeamPlace there = other->at(own->fractionOf(k, std::clamp(from.fraction, span.from, span.to)));
          if (seam.tie == Seam::Tie::Pleat && there.piece == from.piece) continue;  // folded, not sewn
          if (!known(there, curveOf(pattern, there.piece, there.edge)->length())) all.push_back(there);
        }
    }
  all.erase(all.begin());
  return all;
}

}  // namespace karinui
