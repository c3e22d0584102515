#pragma once
// The stretch and shear of Membrane on the grid blocks: the same energy, thread by thread and right angle by right
// angle, in loops without indices. Membrane is the definition; this is its fast form.
#include <span>
#include <vector>

#include "cloth/grid_layout.h"
#include "cloth/membrane.h"

namespace karinui {

// The positive part of the second derivative: on a relative move m of a thread's ends
// the force is across m + (along . m) along; at a right angle between a weft and a warp thread that move by a and b, it
// is that of corner/2 (a . warpWay + weftWay . b)^2 + coupling a . b. Arrays over slots, x y z.
struct GridStiffness {
  std::array<std::vector<float>, 3> weftAlong, warpAlong, weftWay, warpWay;
  std::vector<float> weftAcross, warpAcross, corner;
  // Of the right angles at a node: of weft forth with warp forth and back, of weft back with warp forth and back.
  std::array<std::vector<float>, 4> coupling;
};

class GridMembrane {
 public:
  GridMembrane(const Cloth& cloth, const GridLayout& layout);
  // Adds to the gradient at x, newtons, and finds the stiffness there.
  void evaluate(std::span<const Vec3> x, std::span<Vec3> gradient, GridStiffness& stiffness, Workers& workers);

 private:
  struct Threads {
    ThreadCurve weft, warp;
    ShearCurve shear;
  };
  const GridLayout& layout_;
  std::vector<Threads> threads_;                     // per block
  std::vector<std::vector<NodeIndex>> node_;         // per block
  std::array<std::vector<double>, 3> x_, du_, dv_;   // places, threads; then the threads' forces
  std::vector<double> tu_, tv_, ku_, kv_;            // of the threads: force per length, stiffness along them
  std::array<std::vector<double>, 4> slope_, held_;  // of the four right angles' shear; of the four threads there
};

}  // namespace karinui
