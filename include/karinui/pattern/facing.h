#pragma once
// Facings: the strip of a piece beside a run of its edges, cut once more and turned in there, as at a neckline or a
// front edge. Metres on paper. Pure; any thread.
#include <string>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct Facing {
  Outline outline;
  std::string inner;  // its edge inside the piece
  // Of each other edge of it the part of the piece's outline it is; `facing` has the piece's id left empty.
  struct Part {
    EdgeSpan piece, facing;
  };
  std::vector<Part> parts;
};

// What lies within `width` of the edges, which follow each other on the piece's outline in this order. The edges keep
// their names, also where only a part of them is there. Refuses edges that do not follow each other or close a ring,
// and a piece that is nowhere so deep beside them.
Result<Facing> facingOf(const Piece& piece, const std::vector<std::string>& run, double width);

}  // namespace karinui
