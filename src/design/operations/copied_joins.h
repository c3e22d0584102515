#pragma once
// What joins pieces that are copied: seams and fastenings.
#include <map>

#include "design/operations/operations.h"

namespace karinui {

// Pieces with their copies, which are in the document already.
using CopiesOf = std::map<PieceId, PieceId>;

// The document with the fastenings of `pieces` set on their copies too, where both their sides are on pieces in
// `copies`, which has the pieces and may have others. `mirror`: the copies are mirror images. The others are told.
Document withCopiedFastenings(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies,
                              bool mirror, const Context& context);

// The seams that hold nothing but these pieces: those of their darts and pleats, the one that makes a tube, and those
// that sew them to one another.
std::vector<const Seam*> seamsWithin(const Document& document, const std::vector<PieceRef>& pieces);
// Auto becomes yes where there are any; a record made before there was a choice keeps its meaning.
void decideSeamsWithin(const Document& document, const std::vector<PieceRef>& pieces, Choice& seams,
                       const Context& context);
// The document with the seams within `pieces` sewn on their copies too. `mirror`: they are mirror images.
Document withCopiedSeams(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies, bool mirror);

// What sews pieces to others, as a cuff to its sleeve or a pocket onto a front, and would sew their mirror images to
// the images of those: symmetric copies, or the other halves of symmetric pieces. Where a piece is sewn to inner lines,
// these are drawn there, too. `left`: the seams of which something has no image, or one that is sewn already.
struct MirroredSeams {
  Document document;
  std::size_t sewn = 0;
  std::vector<std::pair<SeamId, PieceId>> left;  // and the piece it is on
};
// `made`: seams that the operation has made before. `rings`: as of mirrorImage().
MirroredSeams withMirroredSeams(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies,
                                std::size_t made, bool rings);

// The same fastening between the symmetric copies of its pieces. Nothing where one has none that is a likeness, or
// where the copies are the pieces themselves, as of two fronts that are buttoned to each other.
std::optional<Fastening> fasteningOnCopies(const Document& document, const Fastening& own);
// Whether it holds the same places together, whatever of it is closed.
bool sameFastening(const Fastening& one, const Fastening& other);

}  // namespace karinui
