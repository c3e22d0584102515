#pragma once
// Pockets that are sewn into a garment go with its edges: what hangs behind an edge, paper on paper, is cut anew with
// it.
#include <set>

#include "design/operations/operations.h"

namespace karinui {

// The pockets of `before` after an operation that cut pieces anew. Tells where the bags of one cannot be cut so.
Document pocketsFollowed(const Document& before, Document after, const Context& context);

// The seams by which bags and side pieces hang behind edges and on each other: what is taken in is not taken in through
// them.
std::set<SeamId> seamsOfPockets(const Pattern& pattern);

// Where a slanted pocket cut an edge's end away: the edges of its side piece, with which that edge goes on. Of one of
// those the others, and that edge.
std::vector<EdgeRef> beyondPockets(const Pattern& pattern, const EdgeRef& edge);

}  // namespace karinui
