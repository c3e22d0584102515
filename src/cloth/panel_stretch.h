#pragma once
// The stretch and shear of Membrane for the part of the cloth that is a panel: the same energy, thread by thread and
// right angle by right angle, in loops without indices. Membrane is the definition; this is its quick form.
#include <span>
#include <vector>

#include "cloth/membrane.h"
#include "cloth/panel_plan.h"

namespace karinui {

// The positive part of the second derivative, as the step's system wants it: on a relative move m of a thread's ends
// the force is across m + (along . m) along; at a right angle between a weft and a warp thread that move by a and b, it
// is that of corner/2 (a . warpWay + weftWay . b)^2. Arrays over slots, x y z.
struct PanelStiffness {
  std::array<std::vector<float>, 3> weftAlong, warpAlong, weftWay, warpWay;
  std::vector<float> weftAcross, warpAcross, corner;
};

class PanelStretch {
 public:
  PanelStretch(const Cloth& cloth, const PanelPlan& plan);
  // Adds to the gradient at x, newtons, and finds the stiffness there.
  void evaluate(std::span<const Vec3> x, std::span<Vec3> gradient, PanelStiffness& stiffness, Workers& workers);

 private:
  struct Threads {
    ThreadCurve weft, warp;
    ShearCurve shear;
  };
  const PanelPlan& plan_;
  std::vector<Threads> threads_;                    // per panel
  std::vector<std::vector<NodeIndex>> node_;        // per panel
  std::array<std::vector<double>, 3> x_, du_, dv_;  // places, threads; then the threads' forces
  std::vector<double> tu_, tv_;
  std::array<std::vector<double>, 4> slope_;  // of the four right angles' shear
};

}  // namespace karinui
