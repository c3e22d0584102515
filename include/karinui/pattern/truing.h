#pragma once
// Truing: whether sewn edges fit each other. The two sides of a seam are walked along each other; where it ends, the
// two pieces' outlines must go on as one smooth line. Metres on paper. Pure; any thread.
#include <map>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

inline constexpr double kFits = 0.0015;     // metres two sides may differ by
inline constexpr double kSmoothCorner = 3;  // degrees two corners may miss a straight line by
inline constexpr double kMeantCorner = 45;  // and from which on they are meant to make a corner

struct SeamTruing {
  SeamId seam;
  double a = 0, b = 0;    // lengths of the two sides
  double ease = 0;        // by how much one of them is longer on purpose
  bool gathered = false;  // 2:1, without a declared ease: nothing is expected of the lengths
  double off() const;     // how much longer the longer side is than it ought to be, or, negative, shorter; 0: gathered
  bool fits() const { return off() <= kFits && off() >= -kFits; }
};

// Where a seam ends at a corner of either piece and the lines go on to both sides of it.
struct CornerTruing {
  SeamId seam;
  struct Side {
    PieceId piece;
    std::string edge;  // that goes on there
    Flat place;
    double angle = 0;  // degrees, within the piece
  } a, b;
  double off() const { return a.angle + b.angle - 180; }  // degrees: more is a dent in the line, less a point
  bool smooth() const { return off() <= kSmoothCorner && off() >= -kSmoothCorner; }
};

struct TruingReport {
  std::vector<SeamTruing> seams;      // all
  std::vector<CornerTruing> corners;  // those that miss a straight line by less than a corner that is meant
  std::size_t faults() const;
};
// `eases`: declared, of single seams.
TruingReport truing(const Pattern& pattern, const std::map<SeamId, double>& eases = {});

// The curve of the edge that goes on beside a trued seam: bent near the corner, at most over `within` and half its
// length, so that of the angle that is off it takes half. Its ends and the rest of it stay.
Curve truedEdge(const Outline& outline, const CornerTruing::Side& side, double off, double within);

}  // namespace karinui
