#pragma once
// Pockets that are a part of the garment's seams, as the pattern shows them. Pure; any thread.
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct SewnPocket {
  SeamId opening;              // of a seam's edges, or of a slanted edge and the line it lies on; held as by basting
  std::vector<SeamId> caught;  // bags and edges of the opening
  SeamId round;                // the bags and each other
};
// Behind each opening hang two pieces that are sewn to each other, paper on paper: one is caught in, turned in, with
// the one edge of the opening; with the other edge the second goes on, or lies beneath with a line.
std::vector<SewnPocket> pocketsOf(const Pattern& pattern);

// The seams by which bags hang behind lines within a piece, as those of a welt pocket.
std::vector<SeamId> bagsOnLines(const Pattern& pattern);

}  // namespace karinui
