#include "karinui/touch/force_law.h"

#include <algorithm>
#include <numbers>

namespace karinui {

std::optional<Facet> facetOf(Vec3 a, Vec3 b, Vec3 c, bool twoSided) {
  Facet facet{{a, b, c}, normalized(cross(b - a, c - a)), (a + b + c) * (1.0 / 3), 0, twoSided};
  if (length(facet.normal) == 0 || !finite(a) || !finite(b) || !finite(c)) return std::nullopt;
  for (const Vec3 corner : facet.corner) facet.radius = std::max(facet.radius, distance(corner, facet.middle));
  return facet;
}

double Stiffness::size() const { return std::sqrt(xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz)); }

Vec3 contactForce(Vec3 penetration, Vec3 normal, double stiffness) {
  return normal * (-stiffness * std::min(0.0, dot(normal, penetration)));
}

Vec3 weightForce(double mass) { return {0, -mass * kGravity, 0}; }

Vec3 springTension(Vec3 place, Vec3 neighbour, double natural, double stiffness) {
  const Vec3 way = neighbour - place;
  const double l = length(way);
  return l > natural && l > 0 ? way * (stiffness * (l - natural) / l) : Vec3{};
}

namespace {

// Visits the straight parts of the curve up to an extension: (length of the part, force before, slope).
template <class Visit>
void along(const TensionCurve& curve, double extension, double steepest, Visit&& visit) {
  double before = 0;
  for (std::size_t i = 0; i + 1 < curve.places.size() && extension > curve.places[i].extension; ++i) {
    const auto& from = curve.places[i];
    const auto& to = curve.places[i + 1];
    const double wide = to.extension - from.extension;
    if (!(wide > 0)) continue;
    const double slope = std::clamp((to.force - from.force) / wide, 0.0, steepest);
    const bool last = i + 2 == curve.places.size();
    const double part = (last ? extension : std::min(extension, to.extension)) - from.extension;
    visit(part, before, slope);
    before += slope * part;
  }
}

}  // namespace

double tension(const TensionCurve& curve, double extension, double steepest) {
  double force = 0;
  along(curve, extension, steepest, [&](double part, double before, double slope) { force = before + slope * part; });
  return force;
}

double storedEnergy(const TensionCurve& curve, double extension, double steepest) {
  double energy = 0;
  along(curve, extension, steepest,
        [&](double part, double before, double slope) { energy += part * (before + slope * part / 2); });
  return energy;
}

Vec3 cuttingForce(double resistance, Vec3 velocity) {
  constexpr double kFull = 0.05;  // m/s
  return velocity * (-resistance / std::max(kFull, length(velocity)));
}

double weaveShare(const Weave& weave, Vec3 place) {
  if (!(weave.period > 0)) return 0;
  const double turn = 2 * std::numbers::pi / weave.period;
  const Vec3 from = place - weave.origin;
  return std::clamp(weave.depth, 0.0, Weave::kMostDepth) * std::sin(turn * (weave.u + dot(weave.warp, from))) *
         std::sin(turn * (weave.v + dot(weave.weft, from)));
}

double clickForce(double since) {
  if (!(since >= 0 && since < kClickSeconds)) return 0;
  return kClickForce / 2 * (1 - std::cos(2 * std::numbers::pi * since / kClickSeconds));
}

}  // namespace karinui
