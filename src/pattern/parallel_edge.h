#pragma once
// An edge carried parallel to itself, as a hem let down or taken up, whose ends go along the edges beside it. Metres on
// paper. Pure; any thread.
#include <optional>
#include <vector>

#include "karinui/geometry/curve.h"

namespace karinui {

// All places as far to the left of a curve, led straight on beyond both of its ends.
class ParallelLine {
 public:
  ParallelLine(const Curve& curve, double by);
  // Where the edge beside meets it: from the corner inwards, or straight on from the corner outwards. Nothing: nowhere,
  // or so far away that the edge beside hardly leads there.
  std::optional<Flat> met(const Curve& beside, bool besideEnds) const;
  // The part of it between two places on it.
  Curve between(Flat from, Flat to) const;

 private:
  struct Nearest {
    std::size_t chord = 0;
    double share = 0;
  };
  Nearest nearest(Flat place) const;
  Curve curve_;
  double by_;
  std::vector<Flat> points_;
};

// The curve with another end that is on it, or straight on beyond it.
Curve endedAt(const Curve& curve, bool atEnd, Flat place);

}  // namespace karinui
