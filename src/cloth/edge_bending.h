#pragma once
// Edges that are stiffer and heavier than the single cloth. A hem that is turned up and sewn down, a seam allowance
// pressed open: these layers are not simulated, they weigh, and they bend as layers do that may slide on each other,
// each as if it were alone (sewn down along one line, not fused); what they add, of the hem's width and of what is
// turned in, acts along the edge. A cord or a strip that is sewn along it.
//   Bending: 1/2 S k^2 per length; of a strip of the cloth itself S = B w. The curvature k along the edge is the second
//   difference over three nodes of the edge and one beside it, weighted so that it vanishes wherever the cloth is flat,
//   straight edge or curved (isometric bending as in bending.h: its second derivative is constant).
#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class EdgeBending : public ElementEnergy<EdgeBending, 4> {
 public:
  explicit EdgeBending(const Cloth& cloth);  // of the live woven pieces
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 4> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;

 private:
  std::vector<std::array<double, 4>> weight_;  // square roots of N/m
};

// What they weigh beyond the single cloth: kg per cloth node.
std::vector<std::pair<NodeIndex, double>> edgeMasses(const Cloth& cloth);

}  // namespace karinui
