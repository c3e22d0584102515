#include "karinui/pattern/facing.h"

namespace karinui {

std::set<PieceId> wornInsideOut(const Pattern& pattern) {
  const auto layerOf = [&](const EdgeSpan& span) { return pattern.pieces.at(span.piece)->layer; };
  // What a piece is sewn onto along a line, as a front onto the side piece of its pocket, shows its right side beside
  // it.
  std::set<std::pair<PieceId, PieceId>> onto;
  for (const auto& [id, seam] : pattern.seams)
    if (seam.tie != Seam::Tie::Pleat)
      for (const EdgeSpan& over : seam.a)
        for (const EdgeSpan& under : seam.b)
          if (!findEdge(*pattern.pieces.at(under.piece), under.edge)) onto.emplace(over.piece, under.piece);
  std::set<PieceId> inside, above;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie != Seam::Tie::Pleat || seam.reversed) continue;
    for (const EdgeSpan& outer : seam.a)
      for (const EdgeSpan& own : seam.b)
        if (layerOf(own) < layerOf(outer) && !onto.contains({outer.piece, own.piece}))
          inside.insert(own.piece), above.insert(outer.piece);
  }
  for (std::size_t before = 0; before != inside.size();) {
    before = inside.size();
    for (const auto& [id, seam] : pattern.seams) {
      if (!seam.reversed) continue;
      for (const EdgeSpan& one : seam.a)
        for (const EdgeSpan& other : seam.b) {
          if (layerOf(one) != layerOf(other)) continue;
          if (inside.contains(one.piece) && !above.contains(other.piece)) inside.insert(other.piece);
          if (inside.contains(other.piece) && !above.contains(one.piece)) inside.insert(one.piece);
        }
    }
  }
  return inside;
}

std::set<PieceId> laidWithin(const Pattern& pattern) {
  std::set<PieceId> within = wornInsideOut(pattern);
  if (within.empty()) return within;
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie != Seam::Tie::Pleat || !seam.reversed) continue;
    for (const EdgeSpan& outer : seam.a)
      for (const EdgeSpan& own : seam.b)
        if (pattern.pieces.at(own.piece)->layer < pattern.pieces.at(outer.piece)->layer) within.insert(own.piece);
  }
  return within;
}

}  // namespace karinui
