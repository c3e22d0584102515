#pragma once
// What joins pieces that are copied: seams and fastenings.
#include <map>

#include "design/operations/operations.h"

namespace karinui {

// The document with the fastenings of `piece` set on its copy too, where both their sides are on pieces in `copies`,
// which has it with its copy. `mirror`: the copies are mirror images. The others are told.
Document withCopiedFastenings(Document document, PieceId piece, const std::map<PieceId, PieceId>& copies, bool mirror,
                              const Context& context);

// The seams that hold nothing but this piece: those of its darts and pleats, and the one that makes it a tube.
std::vector<const Seam*> ownSeams(const Document& document, PieceId piece);
// Auto becomes yes where there are any; a record made before there was a choice keeps its meaning.
void decideSeamsWithin(const Document& document, PieceId piece, Choice& seams, const Context& context);
// The document with these seams sewn on the piece's copy too. `mirror`: it is a mirror image.
Document withCopiedSeams(Document document, PieceId piece, PieceId copy, bool mirror);

// What sews a piece to others, as a cuff to its sleeve or a pocket onto a front, and would sew its mirror image to
// their images: symmetric copies, or the other halves of symmetric pieces. Where a piece is sewn to inner lines, these
// are drawn there, too. `left`: the seams of which something has no image, or one that is sewn already.
struct MirroredSeams {
  Document document;
  std::size_t sewn = 0;
  std::vector<SeamId> left;
};
// `made`: seams that the operation has made before.
MirroredSeams withMirroredSeams(Document document, PieceId piece, PieceId copy, std::size_t made);

// The same fastening between the symmetric copies of its pieces. Nothing where one has none that is a likeness, or
// where the copies are the pieces themselves, as of two fronts that are buttoned to each other.
std::optional<Fastening> fasteningOnCopies(const Document& document, const Fastening& own);
// Whether it holds the same places together, whatever of it is closed.
bool sameFastening(const Fastening& one, const Fastening& other);

}  // namespace karinui
