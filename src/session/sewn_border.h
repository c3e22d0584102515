#pragma once
// The border of a piece and of all that is sewn to it, as one closed line: where an edge ends at a seam the line goes
// on along the neighbour, as the armhole does from the front to the back once the shoulder is sewn. Metres along it, in
// the outlines' direction. A value; any thread.
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/values.h"
#include "karinui/pattern/piece.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

class SewnBorder {
 public:
  // The border that goes through a place; that of its piece alone where the place is sewn already.
  SewnBorder(const Pattern& pattern, const EdgeNear& place);
  double length() const { return length_; }
  std::optional<double> find(PieceId piece, const std::string& edge, double fraction) const;
  std::optional<double> find(const EdgeNear& near) const { return find(near.piece, near.edge, near.fraction); }
  // The parts of edges between two places, `to` at most once round after `from`; in the outlines' order.
  std::vector<EdgeRef> between(double from, double to) const;
  // Corners, middles of edges and notches: where the end of a run snaps to.
  const std::vector<double>& keyStops() const { return stops_; }
  double wrapped(double along) const;  // into 0 … length()

 private:
  struct Part {
    EdgeRef ref;
    double start, length;
  };
  void add(const Piece& piece, const Edge& edge, double from, double to);
  bool walk(const Pattern& pattern, const EdgeNear& place);
  std::vector<Part> parts_;
  std::vector<double> stops_;
  double length_ = 0;
};

}  // namespace karinui
