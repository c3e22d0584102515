#pragma once
// The line along which a piece is cut: each edge's parallel at its seam allowance, led round the corners. Metres on
// paper. Pure; any thread.
#include <optional>
#include <vector>

#include "karinui/pattern/allowance.h"

namespace karinui {

// Where two edges meet, walked with the cloth on the left.
struct CutCorner {
  Flat place;
  Flat before, after;  // unit: the way in along the edge before, the way out along the edge after
  double widthBefore = 0, widthAfter = 0;
  CornerKind kind = CornerKind::Mitre;
};
inline constexpr double kLongestMitre = 3.5;  // in widths of the wider allowance
// From the parallel of the edge before to that of the edge after. Where the outline turns inwards they meet, whatever
// the kind; where it hardly turns and the widths differ there is a step; a kind that would lead farther than the
// longest mitre, or for which the edges turn too little, is a mitre instead.
std::vector<Flat> cornerPoints(const CutCorner& corner);

struct CutLines {
  Ring outer;               // counter-clockwise
  std::vector<Ring> holes;  // counter-clockwise; one that its allowance fills or a folded dart is not there
};
// Nothing: nowhere is there an allowance. `miss`: of chords.
std::optional<CutLines> cutLines(const Piece& piece, const AllowancePlan& plan, double miss = 1e-5);

}  // namespace karinui
