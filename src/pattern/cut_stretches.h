#pragma once
// Where a cutting line runs over a piece. Metres on paper.
#include <optional>
#include <vector>

#include "divide_edges.h"
#include "karinui/pattern/darts.h"

namespace karinui {

struct Stretch {
  std::vector<Flat> line;
  std::optional<EdgePlace> start, end;  // on the outline; nothing: it ends in the cloth
};

// The line straightened, its ends led onto the outline, and what lies outside left off. It may leave the piece through
// one leg of a dart and come back through the other: the next stretch then begins where the two legs are sewn to each
// other. Refused: what cutPiece() (edit.h) refuses of a line.
Result<std::vector<Stretch>> stretchesOver(const Piece& piece, std::vector<Flat> line,
                                           const std::vector<PaperDart>& darts);
// Leads the ends of the line that meet the outline within 3 mm of a corner to the corner, unless the line only takes a
// strip as thin off an edge. Answers whether that changed anything.
bool leadToCorners(const Outline& outline, std::vector<Stretch>& stretches);

}  // namespace karinui
