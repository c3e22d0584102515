#include "karinui/pattern/markings.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kLongSeam = 0.150;      // metres: an eased seam longer than this gets a balance notch in its middle
constexpr double kVeryLongSeam = 0.400;  // an even one too
constexpr double kEased = 1.003;
constexpr double kCornerCosine = 0.85;  // outlines that turn by more than about 32 degrees have a corner of their own

constexpr double kTagDepth = 0.006;  // metres from the edge to the middle of a seam's number

Flat unitTangent(const Curve& curve, double t) {
  const Flat there = curve.tangent(t);
  if (length(there) > 1e-9) return normalized(there);
  return normalized(t < 0.5 ? curve.at(t + 1e-3) - curve.at(t)
                            : curve.at(t) - curve.at(t - 1e-3));  // a handle of no length
}

}  // namespace

std::optional<BorderPlace> borderPlace(const Pattern& pattern, const SeamPlace& at) {
  const auto found = pattern.pieces.find(at.piece);
  if (found == pattern.pieces.end()) return std::nullopt;
  const Piece& piece = *found->second;
  const auto on = [&](const Outline& outline, double side) -> std::optional<BorderPlace> {
    const auto index = outline.find(at.edge);
    if (!index) return std::nullopt;
    const Curve& curve = outline.edges[*index].curve;
    const double t = curve.parameterAt(std::clamp(at.fraction, 0.0, 1.0) * curve.length());
    const Flat along = unitTangent(curve, t);
    BorderPlace out{curve.at(t), leftOf(along) * -side, false};
    const std::size_t count = outline.edges.size();
    const double tiny = 1e-4 / curve.length();
    if (at.fraction < tiny)
      out.corner = dot(unitTangent(outline.edges[(*index + count - 1) % count].curve, 1), along) < kCornerCosine;
    if (at.fraction > 1 - tiny)
      out.corner = dot(unitTangent(outline.edges[(*index + 1) % count].curve, 0), along) < kCornerCosine;
    return out;
  };
  if (const auto outside = on(piece.outline, 1)) return outside;
  for (const Outline& hole : piece.holes)
    if (const auto within = on(hole, -1)) return within;
  return std::nullopt;
}

std::vector<NotchPlace> notchPlaces(const Pattern& pattern) {
  std::vector<NotchPlace> out;
  for (const auto& [id, seam] : pattern.seams) {
    const SeamSides sides(pattern, seam);
    std::vector<double> fractions = sides.breaks();
    if (fractions.empty()) continue;
    const double shorter = std::min(sides.a.length(), sides.b.length()),
                 longer = std::max(sides.a.length(), sides.b.length());
    const bool balance = (longer > kLongSeam && longer > kEased * shorter) || longer > kVeryLongSeam;
    const bool free =
        std::none_of(fractions.begin(), fractions.end(), [](double f) { return std::abs(f - 0.5) < 0.1; });
    if (balance && free) fractions.insert(std::upper_bound(fractions.begin(), fractions.end(), 0.5), 0.5);
    for (const double fraction : fractions) {
      const SeamPlace atA = sides.a.at(fraction), atB = sides.b.at(fraction);
      const auto a = borderPlace(pattern, atA), b = borderPlace(pattern, atB);
      if (!a || !b) continue;
      if (a->corner && b->corner) continue;  // two corners find each other
      out.push_back({atA.piece, a->place, a->outward, seam.name, false, atA.edge});
      out.push_back({atB.piece, b->place, b->outward, seam.name, false, atB.edge});
    }
  }
  for (const auto& [id, piece] : pattern.pieces)
    for (const Mark& mark : piece->marks)
      if (!mark.edge.empty())
        if (const auto on = borderPlace(pattern, {id, mark.edge, mark.fraction}))
          out.push_back({id, on->place, on->outward, "", true, mark.edge});
  return out;
}

PaperStroke strokeOf(const NotchPlace& notch, double allowance) {
  return {notch.place, notch.place + notch.outward * (allowance > 0 ? allowance : -kNotchLength)};
}

std::vector<Flat> drillHoles(const Piece& piece) {
  std::vector<Flat> out;
  for (const Mark& mark : piece.marks)
    if (mark.edge.empty()) out.push_back(mark.place);
  return out;
}

std::vector<SeamTag> seamTags(const Pattern& pattern) {
  std::vector<SeamTag> out;
  std::size_t number = 0;
  for (const auto& [id, seam] : pattern.seams) {
    ++number;
    const SeamSides sides(pattern, seam);
    for (const SeamSide* side : {&sides.a, &sides.b}) {
      const SeamPlace at = side->at(0.5);
      if (const auto on = borderPlace(pattern, at))
        out.push_back({at.piece, on->place - on->outward * kTagDepth, number});
    }
  }
  return out;
}

}  // namespace karinui
