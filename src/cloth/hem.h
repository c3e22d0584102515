#pragma once
// Hems that are turned up and sewn down. Their layers are not simulated: they weigh, and they bend as layers do that
// may slide on each other, each as if it were alone (sewn down along one line, not fused). What a hem adds to the
// single cloth, of its width and of what is turned in, acts along the edge.
//   Bending: 1/2 B w k^2 per length. The curvature k along the edge is the second difference over three nodes of the
//   edge and one beside it, weighted so that it vanishes wherever the cloth is flat, straight edge or curved
//   (isometric bending as in bending.h: its second derivative is constant).
#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class HemBending : public ElementEnergy<HemBending, 4> {
 public:
  explicit HemBending(const Cloth& cloth);  // of the live woven pieces
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 4> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;

 private:
  std::vector<std::array<double, 4>> weight_;  // square roots of N/m
};

// What hems weigh beyond the single cloth: kg per cloth node, nothing where none is turned up.
std::vector<std::pair<NodeIndex, double>> hemMasses(const Cloth& cloth);

}  // namespace karinui
