#pragma once
// Facings: the strip of a piece beside a run of its edges, cut once more and turned in there, as at a neckline or a
// front edge; and what is left of a piece without such a strip. Metres on paper. Pure; any thread.
#include <set>
#include <string>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

// A part of a piece that lies on one side of a line from edge to edge.
struct DividedPart {
  Outline outline;
  std::string inner;  // its edge inside the piece
  // Of each other edge of it the part of the piece's outline it is; `own` has the piece's id left empty.
  struct EdgePart {
    EdgeSpan piece, own;
  };
  std::vector<EdgePart> edges;
};

// What lies within `width` of the edges, which follow each other on the piece's outline in this order. The edges keep
// their names, also where only a part of them is there. Where the inner line would turn in a corner that no corner of
// the piece asks for, it is rounded off, deeper by a little. Refuses edges that do not follow each other or close a
// ring, and a piece that is nowhere so deep beside them.
Result<DividedPart> facingOf(const Piece& piece, const std::vector<std::string>& run, double width);

// The piece without its facing: shorter there by `by`. The inner edge has the name of the run's first. Refuses the
// same.
Result<DividedPart> shortenedAt(const Piece& piece, const std::vector<std::string>& run, double by);

// Facings and linings: pieces that are worn with the right side of their cloth inwards, since they are sewn along the
// edges of a piece above them, paper on paper. Those that are sewn to such a piece in the same layer go with it. They
// are cut with their paper turned over.
std::set<PieceId> wornInsideOut(const Pattern& pattern);

// Those, and underlaps as the shield of a fly: pieces in a lower layer with which the cloth of an edge goes on, beside
// what else the edge is sewn to. They lie within the garment and are laid into it when the rest hangs.
std::set<PieceId> laidWithin(const Pattern& pattern);

}  // namespace karinui
