#include "cloth/self_contact.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kReach = 1.1;  // radii within which a pair that stuck keeps its anchor
// The push over r, the share of the radius by which a pair is nearer, is k radius (kSoft r^2 + kFirm r^6): it begins
// without a jump of its slope. The derivation is told in docs/develop/drape.md, "Constants of contact".
constexpr double kSoft = 0.1, kFirm = 8;
constexpr double kSlipShare = 0.025;  // radii that a pair's friction gives before it slips, at least

// Under one layer or under five cloth rests on cloth at 0.85 to 0.9 radii: there thick cloth should be as far off as
// the two are thick. Thinner contact costs steps: docs/develop/drape_tried.md, "Thinner contact".
constexpr double kPerThickness = 1.15, kLeastRadius = 0.002;
constexpr double kMostShare = 0.3;  // of the spacing: cells not wider than the radius would push themselves apart

double halfRadius(const Cloth& cloth, const Fabric& fabric) {
  return std::fmin(std::fmax(kPerThickness * fabric.thickness, kLeastRadius), kMostShare * cloth.spacing) / 2;
}

std::vector<double> halfRadii(const Cloth& cloth, double radius) {
  std::vector<double> half(cloth.nodeCount, radius / 2);
  if (radius > thickestRadius(cloth)) return half;
  for (const ClothPiece& piece : cloth.pieces)
    std::fill_n(half.begin() + piece.firstNode, piece.lattice->nodes.size(), halfRadius(cloth, piece.fabric));
  return half;
}

std::vector<double> frictionOf(const Cloth& cloth) {
  std::vector<double> friction(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces)
    std::fill_n(friction.begin() + piece.firstNode, piece.lattice->nodes.size(), piece.fabric.frictionCloth);
  return friction;
}

}  // namespace

double thickestRadius(const Cloth& cloth) {
  double most = 0;
  for (const ClothPiece& piece : cloth.pieces) most = std::fmax(most, 2 * halfRadius(cloth, piece.fabric));
  return most;
}

SelfContact::SelfContact(const Cloth& cloth, double radius)
    : radius_(radius),
      stiffness_(kContactStiffness * cloth.spacing * cloth.spacing),
      half_(halfRadii(cloth, radius)),
      topology_(cloth, radius),
      pairs_(topology_, sewn_, radius, cloth.spacing),
      friction_(frictionOf(cloth), stiffness_, kSlipShare * radius),
      filter_(pairs_, sewn_, radius) {}

void SelfContact::setTies(const TieMap& ties) { sewn_ = SewnGroups(ties, topology_.live.size()); }

void SelfContact::detect(const ContactQuery& query, Workers& workers) {
  touching_.clear();
  friction_.clear();
  if (!enabled()) return;
  touching_ = pairs_.find({query.x, {}, kReach * radius_}, workers);
  for (ContactPair& pair : touching_) {
    const double radius = radiusOf(pair), r = std::fmax(0.0, 1 - pair.gap / radius);
    const double firm = kFirm * r * r * r * r;
    pair.push = stiffness_ * radius * (kSoft + firm) * r * r;
    pair.along = stiffness_ * (2 * kSoft + 6 * firm) * r;
  }
  friction_.apply(touching_, query.x, query.sliding);
}

void SelfContact::addGradient(std::span<Vec3> gradient) const {
  for (std::size_t p = 0; p < touching_.size(); ++p) {
    const ContactPair& pair = touching_[p];
    for (int k = 0; k < 4; ++k)
      gradient[pair.node[k]] += (friction_.force(p) - pair.normal * pair.push) * pair.weight[k];
  }
}

void SelfContact::addSlipForce(std::span<Vec3> force) const {
  for (std::size_t p = 0; p < touching_.size(); ++p)
    for (int k = 0; k < 4; ++k) force[touching_[p].node[k]] += friction_.slipForce(p) * touching_[p].weight[k];
}

void SelfContact::addHessian(ContactHessian& hessian) const {
  for (const ContactPair& pair : touching_)
    if (pair.along > 0 || pair.across > 0)
      hessian.addBetween(pair.node, pair.weight, pair.normal, pair.along, pair.across);
}

void SelfContact::limitMove(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) {
  if (enabled()) filter_.apply(x, move, workers);
}

void SelfContact::afterStep(std::span<const Vec3> x, bool friction, Workers&) {
  if (friction) friction_.afterStep(touching_, x);
}

}  // namespace karinui
