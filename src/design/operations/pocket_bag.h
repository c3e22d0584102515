#pragma once
// The paper of a pocket's bags, which is a part of the paper of the piece behind which they hang. Metres.
#include <optional>
#include <string>

#include "design/operations/down_edge.h"
#include "karinui/pattern/facing.h"

namespace karinui {

// The edges of a bag. They are alike on both halves, whatever the piece calls its own.
inline constexpr const char *kBagTop = "top", *kBagSide = "side", *kBagInner = "inner";

struct BagSize {
  double from = 0, to = 0;  // what of the edge is the bag's, from its upper end down
  double low = 0;           // the opening's lower end
  double depth = 0, below = 0;
  double top = 0;     // what of the edge above is the bag's too, from the corner; 0: the bag hangs free of it
  bool half = false;  // it stays on its half of a symmetric piece: there is one on the other, too
};

// A stretch of a curve, by shares of its length.
Curve curvePart(const Curve& curve, double from, double to);

// An outline of edges in the order in which the side runs down, which meet but for the last bits.
Outline bagOutline(std::vector<Edge> edges, bool down);

// The line round a bag, from the lower end of its edge to its upper end, or that on the edge above. Refuses a bag that
// would leave the piece, or meet that of the other half.
Result<std::vector<Curve>> bagLine(const Pattern& pattern, const DownEdge& side, const BagSize& size);

// The bag beside an edge: its part of that edge and of the one above, and that line.
Result<DividedPart> bagBeside(const Pattern& pattern, const DownEdge& side, const BagSize& size);

}  // namespace karinui
