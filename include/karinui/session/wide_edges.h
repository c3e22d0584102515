#pragma once
// The upper edges of skirts and trousers that are wider than the waist they are made for: such a garment slides down
// until the body is as wide as its edge, which is physically right, and not always meant. And those that are narrow
// enough, but went down to the legs while they were put on. Pure; quick; any thread.
#include <vector>

#include "karinui/design/values.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

struct WideEdge {
  std::vector<EdgeRef> run;  // in the outlines' order
  double round = 0;          // metres of it on the paper
  double waist = 0;          // metres round the body at its waist
  double below = 0;          // metres that it lies below the waist
  bool fallen = false;       // off the trunk, round both legs
  bool narrow = false;       // no wider than the waist: only where it has fallen
};

// Of each garment on the body whose topmost edge goes round the trunk below the waist, or round the legs, though
// nothing hangs it from above. None where an elastic gathers the edge, pins hold the garment, or the figure bends at
// waist or hip.
std::vector<WideEdge> wideEdges(const GarmentSnapshot& snapshot);
// What a tailor should know of it, and what mends it.
Message wideEdgeSaid(const Document& document, const WideEdge& edge);

}  // namespace karinui
