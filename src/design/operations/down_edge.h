#pragma once
// An edge as it is measured from its upper end down, whichever way the outline runs along it. Metres on paper.
#include <algorithm>
#include <utility>

#include "design/operations/operations.h"

namespace karinui {

struct DownEdge {
  const Piece& piece;
  const Edge& edge;
  bool down = true;  // the outline runs down along it
  double whole = 0;

  // Both as shares of its length, in the outline's direction.
  std::pair<double, double> shares(double from, double to) const {
    const double a = std::clamp(from / whole, 0.0, 1.0), b = std::clamp(to / whole, 0.0, 1.0);
    return down ? std::pair(a, b) : std::pair(1 - b, 1 - a);
  }
  EdgeSpan span(double from, double to) const {
    const auto [a, b] = shares(from, to);
    return {piece.id, edge.name, a, b};
  }
};

inline DownEdge downEdgeOf(const Document& document, const EdgeRef& ref) {
  const Piece& piece = *document.find(ref.piece.id);
  const Edge& edge = *findEdge(piece, ref.edge);
  return {piece, edge, edge.curve.start.v >= edge.curve.end.v, edge.curve.length()};
}

// The edge that meets the upper end of another, as it is measured from that corner.
struct EdgeAbove {
  const Piece& piece;
  const Edge& edge;
  bool ends = true;  // it ends in the corner
  double whole = 0;

  std::pair<double, double> shares(double from, double to) const {
    const double a = std::clamp(from / whole, 0.0, 1.0), b = std::clamp(to / whole, 0.0, 1.0);
    return ends ? std::pair(1 - b, 1 - a) : std::pair(a, b);
  }
  EdgeSpan span(double from, double to) const {
    const auto [a, b] = shares(from, to);
    return {piece.id, edge.name, a, b};
  }
  Flat at(double metres) const { return edge.curve.atFraction(ends ? 1 - metres / whole : metres / whole); }
};

inline EdgeAbove edgeAbove(const DownEdge& side) {
  const auto& edges = side.piece.outline.edges;
  const std::size_t n = edges.size(), k = *side.piece.outline.find(side.edge.name);
  const Edge& above = edges[(side.down ? k + n - 1 : k + 1) % n];
  return {side.piece, above, side.down, above.curve.length()};
}

}  // namespace karinui
