#pragma once
// Walking along the two sides of a seam together: where the spans of one side end, and which place of the other meets
// it.
#include <string>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

struct SeamPlace {
  PieceId piece;
  std::string edge;
  double fraction = 0;  // of the edge's length
};

// One side of a seam, walked from its first point to its last in the seam's common direction. Fractions count length.
class SeamSide {
 public:
  // `against`: walked against the outlines' own direction.
  SeamSide(const Pattern& pattern, const std::vector<EdgeSpan>& spans, bool against);

  double length() const { return end_.empty() ? 0 : end_.back(); }
  std::vector<double> breaks() const;   // fractions where spans begin or end: 0 … 1, ascending
  SeamPlace at(double fraction) const;  // at a break: on one of the two spans that meet there
  const std::vector<EdgeSpan>& spans() const { return spans_; }
  double fractionOf(std::size_t span, double edgeFraction) const;  // where a place of that span comes on the walk

 private:
  std::vector<EdgeSpan> spans_;  // in the outlines' order
  std::vector<double> end_;      // metres from the first span's start to the end of each
  bool against_;
};

struct SeamSides {
  SeamSide a, b;
  SeamSides(const Pattern& pattern, const Seam& seam) : a(pattern, seam.a, false), b(pattern, seam.b, seam.reversed) {}
  std::vector<double> breaks() const;  // of both sides, without repeats closer than a millionth
};

// The places of edges and inner lines that seams bring to this one, also through one another, as a waist brings its
// band and the band its facing. What is only folded there is left out.
std::vector<SeamPlace> sewnTo(const Pattern& pattern, const SeamPlace& place);

// The edge of an outline or a hole; null where the piece or edge is not there.
const Edge* edgeOf(const Pattern& pattern, PieceId piece, std::string_view edge);
// The same of what a seam can hold, internal lines too.
const Curve* curveOf(const Pattern& pattern, PieceId piece, std::string_view name);

}  // namespace karinui
