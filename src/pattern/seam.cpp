#include <algorithm>

#include "karinui/pattern/piece.h"

namespace karinui {

std::string_view tieName(Seam::Tie tie) {
  return tie == Seam::Tie::OneToOne ? "1:1" : tie == Seam::Tie::TwoToOne ? "2:1" : "pleat";
}

std::optional<Seam::Tie> tieNamed(std::string_view name) {
  for (const auto tie : {Seam::Tie::OneToOne, Seam::Tie::TwoToOne, Seam::Tie::Pleat})
    if (tieName(tie) == name) return tie;
  return std::nullopt;
}

double length(const Pattern& pattern, const std::vector<EdgeSpan>& side) {
  double sum = 0;
  for (const EdgeSpan& span : side) {
    const auto piece = pattern.pieces.find(span.piece);
    if (piece == pattern.pieces.end()) continue;
    const Curve* curve = findCurve(*piece->second, span.edge);
    if (curve) sum += curve->length() * (span.to - span.from);
  }
  return sum;
}

const Edge* findEdge(const Piece& piece, std::string_view name) {
  if (const auto k = piece.outline.find(name)) return &piece.outline.edges[*k];
  for (const Outline& hole : piece.holes)
    if (const auto k = hole.find(name)) return &hole.edges[*k];
  return nullptr;
}

const Curve* findCurve(const Piece& piece, std::string_view name) {
  if (const Edge* edge = findEdge(piece, name)) return &edge->curve;
  for (const InternalLine& line : piece.lines)
    if (line.name == name && line.curves.size() == 1) return &line.curves.front();
  return nullptr;
}

std::vector<const std::vector<EdgeSpan>*> takenSides(const Seam& seam) {
  if (seam.tie == Seam::Tie::Pleat) return {&seam.b};
  return {&seam.a, &seam.b};
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
