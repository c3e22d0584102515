#include <algorithm>

#include "karinui/pattern/piece.h"

namespace karinui {

double length(const Pattern& pattern, const std::vector<EdgeSpan>& side) {
  double sum = 0;
  for (const EdgeSpan& span : side) {
    const auto piece = pattern.pieces.find(span.piece);
    if (piece == pattern.pieces.end()) continue;
    const Edge* edge = findEdge(*piece->second, span.edge);
    if (edge) sum += edge->curve.length() * (span.to - span.from);
  }
  return sum;
}

const Edge* findEdge(const Piece& piece, std::string_view name) {
  if (const auto k = piece.outline.find(name)) return &piece.outline.edges[*k];
  for (const Outline& hole : piece.holes)
    if (const auto k = hole.find(name)) return &hole.edges[*k];
  return nullptr;
}

double easeRatio(const Pattern& pattern, const Seam& seam) {
  const double a = length(pattern, seam.a), b = length(pattern, seam.b);
  const double shorter = std::min(a, b);
  return shorter > 0 ? std::max(a, b) / shorter : 1;
}

double lengthMismatch(const Pattern& pattern, const Seam& seam) {
  return length(pattern, seam.a) - length(pattern, seam.b);
}

}  // namespace karinui
