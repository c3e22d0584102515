#pragma once
// Pleated paper, folded. Metres on paper. Pure; any thread.
#include <vector>

#include "karinui/pattern/pleats.h"

namespace karinui {

// The folds at one height along the lines, and where cloth there lies when they are folded.
struct FoldedPaper {
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
