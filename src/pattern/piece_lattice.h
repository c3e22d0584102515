#pragma once
// The lattice of one piece, from the nodes of its outline and holes.
#include <optional>
#include <vector>

#include "karinui/pattern/lattice.h"

namespace karinui {

struct BorderNodes {
  std::vector<Flat> outline;             // counter-clockwise
  std::vector<std::vector<Flat>> holes;  // each counter-clockwise, as drawn
  // Lines inside: runs of nodes, numbered through outline, holes and then `inner`, the nodes of their own.
  std::vector<Flat> inner = {};
  std::vector<std::vector<std::uint32_t>> lines = {};
};

// Nodes are numbered grid, outline, holes, lines. `clash`: the nodes (counted through outline and holes, then each
// segment of the lines twice) after which two segments cross, if that is why it is refused. The edge table and the hole
// rings are left to the caller.
Result<Lattice> latticeOf(const BorderNodes& border, Flat centre, Flat warp, double spacing,
                          std::optional<std::array<std::size_t, 2>>* clash);

// The middle of the outline's box along and across the grain.
Flat centreOf(const Ring& outline, Flat warp);

}  // namespace karinui
