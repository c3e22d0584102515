#include "cloth/couplings.h"

namespace karinui {

void Couplings::set(std::span<const Coupling> couplings, std::span<const std::uint32_t> slotOf, std::size_t slots) {
  packed_.clear();
  terms_.clear();
  slot_.clear();
  placeOf_.assign(slots, kNoNode);
  for (const Coupling& c : couplings) {
    packed_.push_back(
        {Float4{static_cast<float>(c.normal.x), static_cast<float>(c.normal.y), static_cast<float>(c.normal.z), 0},
         static_cast<float>(c.across), static_cast<float>(c.along - c.across),
         static_cast<std::uint32_t>(terms_.size()), static_cast<std::uint32_t>(c.terms.size())});
    for (const TieMap::Term& term : c.terms) {
      const std::uint32_t slot = slotOf[term.unknown];
      if (placeOf_[slot] == kNoNode) {
        placeOf_[slot] = static_cast<std::uint32_t>(slot_.size());
        slot_.push_back(slot);
      }
      terms_.push_back({placeOf_[slot], static_cast<float>(term.weight)});
    }
  }
  p_.resize(slot_.size());
}

double Couplings::addProduct(const SlotVectors& p, SlotVectors& q) {
  const auto dot = [](Float4 a, Float4 b) {
    const Float4 both = a * b;
    return both[0] + both[1] + both[2];
  };
  for (std::size_t k = 0; k < slot_.size(); ++k) p_[k] = Float4{p[0][slot_[k]], p[1][slot_[k]], p[2][slot_[k]], 0};
  q_.assign(slot_.size(), Float4{});
  double product = 0;
  for (const Packed& c : packed_) {  // in order
    const std::span<const PackedTerm> own = termsOf(c);
    Float4 move{};
    for (const PackedTerm& term : own) move += p_[term.place] * term.weight;
    const Float4 force = move * c.across + c.normal * (c.along * dot(move, c.normal));
    product += dot(force, move);
    for (const PackedTerm& term : own) q_[term.place] += force * term.weight;
  }
  for (std::size_t k = 0; k < slot_.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) q[axis][slot_[k]] += q_[k][axis];
  return product;
}

void Couplings::addDiagonal(DiagonalBlocks& sum) const {
  constexpr std::size_t kFrom[] = {0, 1, 2, 4, 5, 8};
  forEach(0, size(), [&](std::span<const Term> terms, const Block3& block) {
    for (const Term& term : terms)
      for (std::size_t e = 0; e < 6; ++e) sum[e][term.slot] += term.weight * term.weight * block[kFrom[e]];
  });
}

}  // namespace karinui
