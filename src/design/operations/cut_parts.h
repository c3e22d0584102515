#pragma once
// What facings and linings have of the pieces they are cut from: runs of edges, seams and grading.
#include "karinui/design/document.h"
#include "karinui/design/operation.h"
#include "karinui/pattern/facing.h"

namespace karinui {

struct RunOnPiece {
  PieceId piece;
  std::vector<std::string> edges;
};
// The edges in the order of each outline, those that follow each other together.
std::vector<RunOnPiece> runsOf(const Document& document, const std::vector<EdgeRef>& edges);

// What of a seam's side lies on the parts, in their own edges.
std::vector<EdgeSpan> onParts(const std::vector<EdgeSpan>& side, const std::vector<DividedPart::EdgePart>& parts);

// What is declared as ease of a seam, for its copy on such parts: as much of it as they are of its length.
std::optional<double> easeOnParts(const Document& document, const Seam& seam, const Document& after, const Seam& copy);

// The grading of `made`, whose edges are parts of the piece's.
void gradeParts(Grading& grading, const Piece& piece, const std::vector<DividedPart::EdgePart>& parts,
                const Piece& made);

}  // namespace karinui
