#pragma once
// How a woven cloth resists being stretched and sheared in its own plane: warp, weft and shear each by a curve, on
// every triangle of the lattice and of its ring alike, so that a uniform stretch is felt the same across both.
#include "cloth/energy.h"
#include "cloth/panel_plan.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// Force per width at a strain: `squeeze` K below zero, rising over the toe to K. Energy, slope and curvature per area.
struct ThreadCurve {
  double stiffness = 0, squeeze = 0, toe = 0;
  double energy(double strain) const;
  double force(double strain) const;
  double tangent(double strain) const;
};

class Membrane : public ElementEnergy<Membrane, 3> {
 public:
  // Of the live woven pieces; given a plan, of what it leaves.
  explicit Membrane(const Cloth& cloth, const PanelPlan* plan = nullptr);
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 3> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;
  // What stretched threads pull at these nodes with, newtons; squeezed threads, shear and weight are left out. Threads
  // within the patch cancel.
  Vec3 tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const;

 private:
  struct Threads {  // of one piece
    ThreadCurve warp, weft;
    double shear = 0;
  };
  struct Share {  // of one triangle: unit weft and warp, carried by the cloth, are sums of corners
    std::array<double, 3> weft{}, warp{};
    double area = 0;
    std::uint32_t threads = 0;
  };
  struct Thread {  // what a triangle adds to the tension in its threads, for the hand
    std::array<NodeIndex, 3> node{};
    Share share;
  };
  std::vector<Threads> threads_;
  std::vector<Share> share_;
  std::vector<Thread> all_;  // every triangle
};

}  // namespace karinui
