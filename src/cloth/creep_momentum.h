#pragma once
// Nesterov's momentum for cloth that creeps. A creeping step has hardly any inertia, and threads, which strain to
// second order, allow it no more than about a millimetre, whatever the matrix. So each step goes ahead by a share of
// the last move, takes forces and system there, and adds what it solves for: the solve corrects what going ahead
// strained. The share grows as k/(k + 3) over k creeping steps and starts again at 0 where directions part (adaptive
// restart, O'Donoghue and Candes 2015).
#include <algorithm>
#include <cmath>
#include <vector>

#include "cloth/energy.h"

namespace karinui {

class CreepMomentum {
 public:
  // The share of the last move to go ahead by in the next step; 0: none. `creeps`: whether the next step may.
  double share(bool creeps, double spacing) {
    if (!creeps || move_.empty()) {
      steps_ = 0;
      return 0;
    }
    ++steps_;
    const double share = std::fmin(kMost, steps_ / (steps_ + 3.0));
    return share * longest_ > kReach * spacing ? kReach * spacing / longest_ : share;
  }
  const std::vector<Vec3>& lastMove() const { return move_; }
  // After each step: its move, the longest of a node, and the cosine with the move before.
  void afterStep(const std::vector<Vec3>& move, double longest, bool shortened, double along) {
    move_ = move;
    longest_ = longest;
    if (shortened || along < kPart) steps_ = 0;
  }
  void reset() {
    move_.clear();
    steps_ = 0;
  }

 private:
  static constexpr double kMost = 0.92;  // of the last move,
  static constexpr double kReach = 0.3;  // and no node by more spacings than this
  static constexpr double kPart = 0.5;   // cosine below which it starts again
  std::vector<Vec3> move_;
  double longest_ = 0;  // metres
  int steps_ = 0;       // ahead so far
};

}  // namespace karinui
