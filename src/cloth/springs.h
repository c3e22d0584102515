#pragma once
// Tension-only springs. Two uses: the historical simcloth, and the edge of seams and hems.
//   simcloth: each lattice node to its eight neighbours and the four nodes one further along warp and weft,
//             force K (x - x_k)(l - L)/l, only when l > L. Convex: with gravity alone there is one rest.
//   edge:     a seam's stitches and a finished edge keep neighbours from drifting apart.
#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

class Springs : public ElementEnergy<Springs, 2> {
 public:
  struct Spring {
    NodeIndex a = 0, b = 0;
    double length = 0, stiffness = 0;  // m, N/m
  };
  Springs(const std::vector<Spring>& springs, std::size_t nodeCount);
  double elementValue(std::size_t e, const Corners& x) const;
  void elementGradient(std::size_t e, const Corners& x, std::span<Vec3, 2> out) const;
  void elementBlocks(std::size_t e, const Corners& x, std::span<Block3> out) const;
  // Springs slack by less than this many metres enter the matrix as if they were taut. Set to the move of a step, it
  // keeps steps from alternating between taut and slack. Forces, and so rest, are the same.
  void setSlackTolerance(double metres) { slackTolerance_ = metres; }
  Vec3 tensionAt(std::span<const Vec3> x, const std::vector<std::uint8_t>& patch) const;  // as of Membrane

 private:
  std::vector<double> length_, stiffness_;
  double slackTolerance_ = 0;
};

std::vector<Springs::Spring> simclothSprings(const Cloth& cloth);  // of the live simcloth pieces
std::vector<Springs::Spring> edgeSprings(const Cloth& cloth);      // of the live woven pieces' seams and outlines

}  // namespace karinui
