#include "cloth/contact.h"

#include <cmath>

namespace karinui {
namespace {

// Adds a node's own stiffness to the unknowns it depends on. Off the diagonal nothing is added: the sum of the weights
// on it instead bounds the true matrix from above.
template <class BlockOf>
void addToUnknowns(std::span<const TieMap::Term> parts, BlockSystem& system, const BlockOf& blockOf) {
  double whole = 0;
  for (const TieMap::Term& part : parts) whole += std::fabs(part.weight);
  for (const TieMap::Term& part : parts) system.addDiagonal(part.unknown, blockOf(whole, std::fabs(part.weight)));
}

}  // namespace

void ContactHessian::addIsotropic(NodeIndex node, double stiffness) {
  addToUnknowns(ties_.terms(node), system_, [&](double whole, double weight) {
    Block3 block{};
    block[0] = block[4] = block[8] = static_cast<float>(stiffness * whole * weight);
    return block;
  });
}

void ContactHessian::addAtNode(NodeIndex node, double weight, Vec3 normal, double along, double across) {
  atNodes_.push_back({node, weight, along, across, normal});
}

void ContactHessian::addBetween(std::span<const NodeIndex> nodes, std::span<const double> weights, Vec3 normal,
                                double along, double across) {
  couplings_.push_back({termsOf(ties_, nodes, weights), normal, along, across});
}

void ContactHessian::finish() {
  for (const AtNode& at : atNodes_)
    addToUnknowns(ties_.terms(at.node), system_, [&](double whole, double weight) {
      const double share = whole * weight * at.weight;
      Block3 block{};
      addIdentityAndOuter(block, share * at.across, share * (at.along - at.across), at.normal);
      return block;
    });
  system_.setCouplings(couplings_);
}

}  // namespace karinui
