#include "design/operations/cut_parts.h"

#include <algorithm>

namespace karinui {

std::vector<RunOnPiece> runsOf(const Document& document, const std::vector<EdgeRef>& edges) {
  std::vector<RunOnPiece> runs;
  std::vector<PieceId> pieces;
  for (const EdgeRef& edge : edges)
    if (std::find(pieces.begin(), pieces.end(), edge.piece.id) == pieces.end()) pieces.push_back(edge.piece.id);
  for (const PieceId id : pieces) {
    const auto& all = document.find(id)->outline.edges;
    const std::size_t n = all.size();
    const auto meant = [&](std::size_t k) {
      return std::find(edges.begin(), edges.end(), EdgeRef{PieceRef(id), all[k % n].name}) != edges.end();
    };
    std::size_t start = 0;
    while (start < n && meant(start)) ++start;  // begun where no run goes on
    for (std::size_t k = 0; k < n; ++k) {
      if (!meant(start + k)) continue;
      if (k == 0 || !meant(start + k - 1)) runs.push_back({id, {}});
      runs.back().edges.push_back(all[(start + k) % n].name);
    }
  }
  return runs;
}

std::vector<EdgeSpan> onParts(const std::vector<EdgeSpan>& side, const std::vector<DividedPart::EdgePart>& parts) {
  std::vector<EdgeSpan> now;
  for (const EdgeSpan& span : side)
    for (const DividedPart::EdgePart& part : parts) {
      if (part.piece.piece != span.piece || part.piece.edge != span.edge) continue;
      const double from = std::max(span.from, part.piece.from), to = std::min(span.to, part.piece.to);
      const double whole = part.piece.to - part.piece.from;
      if (to - from < 1e-6) continue;
      EdgeSpan own = part.own;
      own.from = (from - part.piece.from) / whole, own.to = (to - part.piece.from) / whole;
      now.push_back(own);
    }
  return now;
}

std::optional<double> easeOnParts(const Document& document, const Seam& seam, const Document& after, const Seam& copy) {
  const auto ease = document.eases.find(seam.id);
  if (ease == document.eases.end()) return std::nullopt;
  const double whole = length(document.pattern, seam.a) + length(document.pattern, seam.b);
  const double part = length(after.pattern, copy.a) + length(after.pattern, copy.b);
  const double share = whole > 0 ? std::min(1.0, part / whole) : 0;
  // The paper of a copy is the piece's to the last bits at best.
  const double by = share > 1 - 1e-6 ? ease->second : ease->second * share;
  return by > 0 ? std::optional(by) : std::nullopt;
}

void gradeParts(Grading& grading, const Piece& piece, const std::vector<DividedPart::EdgePart>& parts,
                const Piece& made) {
  if (!grading.pieces.contains(piece.id)) return;
  Grading own = grading;
  EdgeMap map;
  for (const Edge& edge : piece.outline.edges) map[{piece.id, edge.name}];
  for (const DividedPart::EdgePart& part : parts)
    map[{piece.id, part.piece.edge}].push_back({part.piece.from, part.piece.to, {made.id, part.own.edge, 0, 1}});
  updateGrading(own, piece, map, {&made});
  grading.pieces[made.id] = own.pieces.at(made.id);
}

}  // namespace karinui
