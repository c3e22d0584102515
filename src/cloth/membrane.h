#pragma once
// Stretch and shear of woven cloth in its own plane: warp, weft and shear each by a curve, on every triangle of the
// lattice and of its ring alike, so that a uniform stretch has one stress across both.
#include "cloth/energy.h"
#include "cloth/grid_layout.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// Energy per area of a right angle that was sheared until warp . weft = s. Its slope by the angle g is G (g + k g^3) up
// to the fifth order, and it stays a smooth polynomial for crushed cloth.
struct ShearCurve {
  double modulus = 0, stiffening = 0;  // G; k
  double cubic() const { return 2.0 / 3 + stiffening; }
  double energy(double s) const { return modulus * (0.5 * s * s + 0.25 * cubic() * s * s * s * s); }
  double slope(double s) const { return modulus * (s + cubic() * s * s * s); }
  double curvature(double s) const { return modulus * (1 + 3 * cubic() * s * s); }
};

class Membrane : public ElementEnergy<Membrane, 3> {
 public:
  // Of the live woven pieces; given a layout, of what its grid blocks do not hold.
  explicit Membrane(const Cloth& cloth, const GridLayout* layout = nullptr);
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 3> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;
  // The force of stretched threads on these nodes, newtons; compressed threads, shear and weight are left out. Threads
  // within the patch cancel.
  Vec3 tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const;

 private:
  struct Threads {  // of one piece
    ThreadCurve warp, weft;
    ShearCurve shear;
  };
  struct Gradient {  // of one triangle: the deformation gradient's columns (weft, warp) as sums of corners
    std::array<double, 3> weft{}, warp{};
    double area = 0;
    std::uint32_t threads = 0;
  };
  struct Tension {  // of a triangle's threads, for the hand
    std::array<NodeIndex, 3> node{};
    Gradient gradient;
  };
  std::vector<Threads> threads_;
  std::vector<Gradient> gradient_;
  std::vector<Tension> all_;  // every triangle
};

}  // namespace karinui
