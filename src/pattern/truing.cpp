#include "karinui/pattern/truing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr double kEnd = 1e-6;  // of an edge's length: a seam that ends nearer to its corner ends there

// The corner in which a side of a seam ends; nothing: it ends within an edge.
std::optional<CornerTruing::Side> cornerAt(const Pattern& pattern, const SeamPlace& at) {
  const auto found = pattern.pieces.find(at.piece);
  if (found == pattern.pieces.end()) return std::nullopt;
  const Outline& outline = found->second->outline;
  const auto k = outline.find(at.edge);
  if (!k || (at.fraction > kEnd && at.fraction < 1 - kEnd)) return std::nullopt;
  const std::size_t n = outline.edges.size();
  const bool atEnd = at.fraction > 0.5;
  const std::size_t other = (*k + (atEnd ? 1 : n - 1)) % n;
  const Curve &own = outline.edges[*k].curve, &next = outline.edges[other].curve;
  const Flat in = endTangent(atEnd ? own : next, true), out = endTangent(atEnd ? next : own, false);
  const double turned = angleFrom(in, out) * 180 / std::numbers::pi;
  return CornerTruing::Side{at.piece, outline.edges[other].name, atEnd ? own.end : own.start, 180 - turned};
}

bool sewnToEachOther(const Pattern& pattern, const CornerTruing::Side& a, const CornerTruing::Side& b) {
  const auto holds = [](const std::vector<EdgeSpan>& spans, const CornerTruing::Side& side) {
    return std::any_of(spans.begin(), spans.end(),
                       [&](const EdgeSpan& span) { return span.piece == side.piece && span.edge == side.edge; });
  };
  return std::any_of(pattern.seams.begin(), pattern.seams.end(), [&](const auto& one) {
    const Seam& seam = one.second;
    return (holds(seam.a, a) && holds(seam.b, b)) || (holds(seam.a, b) && holds(seam.b, a));
  });
}

}  // namespace

double SeamTruing::off() const { return gathered ? 0 : std::abs(a - b) - ease; }

std::size_t TruingReport::faults() const {
  return static_cast<std::size_t>(
      std::count_if(seams.begin(), seams.end(), [](const SeamTruing& seam) { return !seam.fits(); }) +
      std::count_if(corners.begin(), corners.end(), [](const CornerTruing& corner) { return !corner.smooth(); }));
}

TruingReport truing(const Pattern& pattern, const std::map<SeamId, double>& eases) {
  TruingReport report;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie == Seam::Tie::Pleat) continue;  // cut by one curve
    const SeamSides sides(pattern, seam);
    const auto declared = eases.find(id);
    SeamTruing walked{id, sides.a.length(), sides.b.length(), 0, false};
    if (declared != eases.end()) walked.ease = declared->second;
    walked.gathered = seam.tie == Seam::Tie::TwoToOne && declared == eases.end();
    report.seams.push_back(walked);
    for (const double end : {0.0, 1.0}) {
      const auto a = cornerAt(pattern, sides.a.at(end)), b = cornerAt(pattern, sides.b.at(end));
      if (!a || !b || (a->piece == b->piece && distance(a->place, b->place) < kEnd)) continue;  // the point of a dart
      if (sewnToEachOther(pattern, *a, *b)) continue;  // the seam goes on there
      const CornerTruing corner{id, *a, *b};
      if (std::abs(corner.off()) < kMeantCorner) report.corners.push_back(corner);
    }
  }
  return report;
}

Curve truedEdge(const Outline& outline, const CornerTruing::Side& side, double off, double within) {
  Curve curve = outline.edges[*outline.find(side.edge)].curve;
  const bool atEnd = distance(curve.end, side.place) < distance(curve.start, side.place);
  if (atEnd) curve = curve.reversed();
  const double whole = curve.length(), t = curve.parameterAt(std::min(within, whole / 2));
  const Flat from = curve.start, until = curve.at(t), way = normalized(curve.tangent(t));
  const double handle = distance(from, until) / 3, turn = off / 2 * std::numbers::pi / 180 * (atEnd ? -1 : 1);
  const Flat out = endTangent(curve, false);
  const Flat turned = out * std::cos(turn) + leftOf(out) * std::sin(turn);
  const Curve both[] = {Curve::cubic(from, from + turned * handle, until - way * handle, until), curve.part(t, 1)};
  const Curve trued = Curve::joined(both);
  return atEnd ? trued.reversed() : trued;
}

}  // namespace karinui
