#include "karinui/pattern/symmetry.h"

#include <cmath>
#include <numbers>

namespace karinui {
namespace {

constexpr double kSame = 2e-5;  // metres: drawn and drafted pieces are exact, imported ones rounded

// The axis if edge k were the image of edge (sum - k): mirroring turns the order round.
std::optional<PaperSymmetry> symmetryWith(const Outline& outline, std::size_t sum) {
  const auto& edges = outline.edges;
  const std::size_t n = edges.size();
  PaperSymmetry found;
  double widest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    found.partner.push_back((sum + n - k) % n);
    const Flat a = edges[k].curve.start, b = edges[found.partner[k]].curve.end;
    if (distance(a, b) <= widest) continue;
    widest = distance(a, b);
    found.through = (a + b) * 0.5;
    found.axis = leftOf(normalized(b - a));
  }
  if (widest < 1e-3) return std::nullopt;
  if (found.axis.v < 0) found.axis = -found.axis;
  for (std::size_t k = 0; k < n; ++k) {
    const Curve here = edges[k].curve, there = edges[found.partner[k]].curve.reversed();
    for (const double f : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (distance(found.image(here.atFraction(f)), there.atFraction(f)) > kSame) return std::nullopt;
  }
  return found;
}

}  // namespace

std::optional<PaperSymmetry> symmetryOf(const Outline& outline) {
  std::optional<PaperSymmetry> best;
  for (std::size_t sum = 0; sum < outline.edges.size(); ++sum) {
    auto found = symmetryWith(outline, sum);
    if (found && found->axis.v >= (best ? best->axis.v + 1e-9 : std::sqrt(0.5) + 1e-9)) best = std::move(found);
  }
  return best;
}

Outline symmetrised(Outline outline, const PaperSymmetry& symmetry) {
  auto& edges = outline.edges;
  const std::size_t n = edges.size();
  // Corners first: edge k starts where its partner's image ends, that is where the edge behind the partner starts.
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t other = (symmetry.partner[k] + 1) % n;
    if (other < k) continue;
    const Flat corner = (edges[k].curve.start + symmetry.image(edges[other].curve.start)) * 0.5;
    edges[k].curve.start = corner;
    if (other != k) edges[other].curve.start = symmetry.image(corner);
  }
  for (std::size_t k = 0; k < n; ++k) edges[k].curve.end = edges[(k + 1) % n].curve.start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t other = symmetry.partner[k];
    Curve& curve = edges[k].curve;
    if (other > k) {
      edges[other].curve = symmetry.image(curve).reversed();
    } else if (other == k && curve.kind != Curve::Kind::Line) {  // its second half is the image of its first
      Curve half = curve.part(0, curve.parameterAt(curve.length() / 2));
      half.end = (half.end + symmetry.image(half.end)) * 0.5;
      if (half.kind == Curve::Kind::Cubic) {  // and they meet without a kink
        const Flat across = leftOf(symmetry.axis);
        half.control2 = half.end + across * dot(half.control2 - half.end, across);
      }
      curve = Curve::joined(std::vector<Curve>{half, symmetry.image(half).reversed()});
    }
  }
  return outline;
}

Outline onBothHalves(const Outline& before, Outline now, const PaperSymmetry& symmetry) {
  auto& edges = now.edges;
  const std::size_t n = edges.size();
  const auto halfway = [&](Flat a, Flat b) { return (a + symmetry.image(b)) * 0.5; };
  // Corners: edge k starts where the edge behind its partner starts.
  const Outline done = now;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t other = (symmetry.partner[k] + 1) % n;
    const auto moved = [&](std::size_t c) { return !(done.edges[c].curve.start == before.edges[c].curve.start); };
    if (moved(k) && (other == k || !moved(other)))
      edges[other].curve.start = other == k ? halfway(done.edges[k].curve.start, done.edges[k].curve.start)
                                            : symmetry.image(done.edges[k].curve.start);
  }
  for (std::size_t k = 0; k < n; ++k) edges[k].curve.end = edges[(k + 1) % n].curve.start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t other = symmetry.partner[k];
    const auto changed = [&](std::size_t e) { return !(done.edges[e].curve == before.edges[e].curve); };
    Curve& curve = edges[k].curve;
    if (!changed(k)) continue;
    if (other != k) {
      if (k < other || !changed(other)) edges[other].curve = symmetry.image(curve).reversed();
    } else if (curve.kind == Curve::Kind::Cubic) {  // it crosses the axis: as much on both sides
      const Curve image = symmetry.image(curve).reversed();
      curve.control1 = (curve.control1 + image.control1) * 0.5;
      curve.control2 = (curve.control2 + image.control2) * 0.5;
      for (std::size_t i = 0; i < curve.between.size(); ++i)
        curve.between[i] = (curve.between[i] + image.between[i]) * 0.5;
    }
  }
  return now;
}

}  // namespace karinui
