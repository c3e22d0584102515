#pragma once
// Pressed folds: along the line hinges whose rest angle is the fold's, of the energy 1/2 c (t - t0)^2 per length with
// t the angle between the cloth on both sides (hinges of Grinspun et al. 2003, here between places on the cloth, so
// that the line may lie across its threads). A hinge reaches one spacing h to either side. There the cloth's own
// bending stores 2 B/h sin^2(t/2); with c = B/h p/(1 - p) a free strip rests where c (t0 - t) = B/h sin t, at p t0 or a
// little more.
#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class CreaseHinges : public ElementEnergy<CreaseHinges, 12> {
 public:
  explicit CreaseHinges(const Cloth& cloth);  // of the live pieces
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 12> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;

 private:
  // Places: the line's two, then one on its left and one on its right; each in a triangle, by its weights.
  struct Hinge {
    std::array<double, 12> weight{};
    double rest = 0, stiffness = 0;  // radians; N m per radian
  };
  struct Bent {
    double angle = 0;
    std::array<Vec3, 4> slope;  // of the angle by each place
  };
  Bent bent(std::size_t e, const Corners& x) const;
  double offRest(std::size_t e, double angle) const;
  std::vector<Hinge> hinges_;
};

}  // namespace karinui
