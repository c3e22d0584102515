#pragma once
// The stiffness between unknowns that are in contact, fastened or drawn together, as every iteration of the solver
// reads it: packed in float, one coupling after the other. Their slots are numbered anew, so that p and q of what is
// coupled lie together.
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/energy.h"
#include "cloth/grid_product.h"
#include "cloth/tie_map.h"

namespace karinui {

// `along` n n^T + `across` (I - n n^T) on the weighted sum of its unknowns.
struct Coupling {
  std::vector<TieMap::Term> terms;
  Vec3 normal;
  double along = 0, across = 0;  // N/m
};

class Couplings {
 public:
  // `slotOf`: of each unknown, below `slots`.
  void set(std::span<const Coupling> couplings, std::span<const std::uint32_t> slotOf, std::size_t slots);
  std::size_t size() const { return packed_.size(); }

  // q += C p, in the order they were set; returns p . C p.
  double addProduct(const SlotVectors& p, SlotVectors& q);
  void addDiagonal(DiagonalBlocks& sum) const;

  struct Term {
    std::uint32_t slot = 0;
    float weight = 1;
  };
  // Calls visit(terms, block) for some of them: the stiffness `block` on the weighted sum of the terms.
  template <class Visit>
  void forEach(std::size_t begin, std::size_t end, Visit visit) const {
    std::vector<Term> terms;
    for (std::size_t k = begin; k < end; ++k) {
      const Packed& c = packed_[k];
      terms.clear();
      for (const PackedTerm& term : termsOf(c)) terms.push_back({slot_[term.place], term.weight});
      Block3 block{};
      addIdentityAndOuter(block, c.across, c.along, {c.normal[0], c.normal[1], c.normal[2]});
      visit(std::span<const Term>(terms), block);
    }
  }

 private:
  using Float4 = float __attribute__((vector_size(16)));
  struct Packed {
    Float4 normal{};
    float across = 0, along = 0;  // along: beyond `across`
    std::uint32_t first = 0, count = 0;
  };
  struct PackedTerm {
    std::uint32_t place = 0;  // in slot_
    float weight = 1;
  };
  std::span<const PackedTerm> termsOf(const Packed& of) const { return {terms_.data() + of.first, of.count}; }

  std::vector<Packed> packed_;
  std::vector<PackedTerm> terms_;
  std::vector<std::uint32_t> slot_, placeOf_;  // that are coupled; the place in it of each slot that is
  std::vector<Float4> p_, q_;                  // of slot_
};

}  // namespace karinui
