#pragma once
// The edges that an operation finishes: those named, their images on a symmetric piece's other half, and those of the
// symmetric copies.
#include <set>

#include "design/operations/operations.h"

namespace karinui {

struct FinishedEdge {
  PieceId piece;
  std::size_t edge = 0;  // of the piece's outline
  bool back = false;     // it runs the other way than the one named
};
std::vector<FinishedEdge> finishedEdges(const Document& document, const std::vector<EdgeRef>& named, bool bothHalves);
// Whole edges; Auto is decided. Refuses unknown edges, and Yes where no piece is symmetric.
Done resolveFinished(const Document& before, std::vector<EdgeRef>& edges, Choice& symmetric, Context& context);

// The inner line that is the image of a piece's line on its symmetric copy, by where it lies; null: there is none.
const InternalLine* lineOnCopy(const InternalLine& line, const Piece& copy);

// The same of edges and inner lines alike.
std::set<Allowances::At> finishedPlaces(const Document& document, const std::vector<EdgeRef>& named, Choice symmetric);
Done resolveFinishedLines(const Document& before, std::vector<EdgeRef>& named, Choice& symmetric, Context& context);
// With the inner lines among them as one curve each.
Document withOneCurveEach(Document document, const std::set<Allowances::At>& edges);
// Whether a seam holds more of an edge than the place of a strap or a loop: such an edge is not free to be finished.
bool heldBySeam(const Document& document, const Allowances::At& edge);
// Cloth that was at rest is no longer.
Document disturbed(Document document, const std::set<Allowances::At>& edges);

}  // namespace karinui
