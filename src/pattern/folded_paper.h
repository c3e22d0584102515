#pragma once
// Pleated paper, folded. Metres on paper. Pure; any thread.
#include <vector>

#include "karinui/pattern/pleats.h"

namespace karinui {

// The folds at one height along the lines, and where cloth there lies when they are folded.
struct FoldedPaper {
  static constexpr double kShort = 3e-4;   // metres by which a fold stands short of where it is pressed
  static constexpr double kOnFold = 1e-7;  // metres: nearer than this a place lies on a fold
  static constexpr double kPasses = 0.01;  // metres: so far the upper layer passes the fold inside before it comes
                                           // down, and in as much again it does
  struct Fold {
    double at, low, strip;  // as of PleatFold
    bool toStart;
  };
  Flat across;  // unit
  double depth;
  bool overlapping;         // each covers a part of the next
  std::vector<Fold> folds;  // ascending
  FoldedPlace folded(Flat place) const;

 private:
  FoldedPlace layered(Flat place) const;
  FoldedPlace shingled(Flat place) const;
};

}  // namespace karinui
