#include "cloth/fastener.h"

#include <algorithm>
#include <cmath>

#include "cloth/membrane.h"
#include "cloth/tie_map.h"
#include "karinui/base/sort_once.h"

namespace karinui {

namespace {

constexpr double kStiffness = 2000;     // N/m: a newton moves it by half a millimetre, as the cloth around it gives
constexpr double kMostForce = 60;       // N
constexpr double kLeastRadius = 0.002;  // metres
constexpr double kSlack = 0.75;         // cloth radii that a button's shank lets its place move freely
constexpr double kOff = 1.25;           // cloth radii between cloth buttoned over cloth
constexpr double kRise = 0.3;           // of the way left: how far off the other's right side cloth is led to it,
constexpr double kMostRise = 0.02;      // metres at most
constexpr double kTaut = 0.0005;        // metres: slacker by less counts as taut in the step's matrix
constexpr double kHolds = 0.005;        // metres beyond which a closed fastening does not hold

Vec3 weighted(const ClothFastener& fastener, std::span<const Vec3> x) {
  Vec3 way;
  for (std::size_t c = 0; c < 6; ++c) way += x[fastener.nodes[c]] * fastener.weights[c];
  return way;
}

}  // namespace

FastenerContact::Pull FastenerContact::pullOf(const ClothFastener& fastener, std::span<const Vec3> x,
                                              double clothRadius) {
  const double radius = std::fmax(clothRadius, kLeastRadius);
  Vec3 way = weighted(fastener, x);
  double slack = std::fmax(fastener.gap, kOff * radius);
  if (fastener.laps) {
    const Vec3 corner = x[fastener.nodes[3]];
    const Vec3 out = normalized(cross(x[fastener.nodes[4]] - corner, x[fastener.nodes[5]] - corner));
    way -= out * std::clamp(kRise * length(way), kOff * radius, std::fmax(kOff * radius, kMostRise));
    slack = kSlack * radius;
  }
  const double l = length(way);
  if (!(l > std::fmax(1e-6, slack - kTaut))) return {};
  Pull pull;
  pull.way = way * (1 / l);
  const double force = kStiffness * (l - slack);
  pull.force = std::clamp(force, 0.0, kMostForce);
  pull.along = force < kMostForce ? kStiffness : 0;
  pull.across = pull.force / l;
  return pull;
}

void FastenerContact::detect(const ContactQuery& query, Workers&) {
  pulls_.clear();
  for (const ClothFastener& fastener : cloth_.fasteners) pulls_.push_back(pullOf(fastener, query.x, clothRadius_));
}

void FastenerContact::addGradient(std::span<Vec3> gradient) const {
  for (std::size_t k = 0; k < pulls_.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c)
      gradient[cloth_.fasteners[k].nodes[c]] += pulls_[k].way * (pulls_[k].force * cloth_.fasteners[k].weights[c]);
}

void FastenerContact::addHessian(ContactHessian& hessian) const {
  for (std::size_t k = 0; k < pulls_.size(); ++k)
    if (pulls_[k].along > 0 || pulls_[k].across > 0)
      hessian.addBetween(cloth_.fasteners[k].nodes, cloth_.fasteners[k].weights, pulls_[k].way,
                         std::fmax(pulls_[k].along, pulls_[k].across), pulls_[k].across);
}

bool FasteningPull::holds() const { return force < kMostForce && gap < kHolds; }

std::vector<FasteningPull> fasteningPulls(const Cloth& cloth, const ClothState& state) {
  std::vector<FasteningPull> all;
  for (const ClothFastener& one : cloth.fasteners)
    all.push_back({one.name, one.kind, one.number,
                   std::fmax(0, length(weighted(one, state.position)) - (one.kind == FasteningKind::Tie ? one.gap : 0)),
                   FastenerContact::pullOf(one, state.position, 0).force, 0});
  if (cloth.zips.empty()) return all;
  std::vector<Vec3> gradient(cloth.nodeCount);
  Workers here(1);
  Membrane(cloth).addGradient(state.position, gradient, here);
  for (const ClothZip& zip : cloth.zips) {
    FasteningPull pull{zip.name, FasteningKind::Zip, 0, 0, 0, zip.length};
    std::vector<std::uint32_t> over;  // its nodes on side a
    for (const Tie& tie : cloth.ties) {
      if (tie.seam != zip.seam) continue;
      pull.gap = std::fmax(pull.gap, length(gapOf(tie, state.position)));
      over.push_back(tie.a);
    }
    sortOnce(over);
    for (const std::uint32_t node : over) pull.force += length(gradient[node]);
    all.push_back(std::move(pull));
  }
  return all;
}

}  // namespace karinui
