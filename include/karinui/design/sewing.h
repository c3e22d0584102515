#pragma once
// Seams before they are sewn: their mirror image, how much a fabric gathers, and what a person should be asked first.
// Operations are taken as they are recorded (ids, not names). Pure; any thread. Metres.
#include <optional>
#include <vector>

#include "karinui/design/operation.h"

namespace karinui {

double lengthOf(const Document& document, const std::vector<EdgeRef>& side);
bool overlap(const EdgeRef& a, const EdgeRef& b);
bool overlap(const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b);
// The seams that hold a part of one of these edges.
std::vector<SeamId> seamsOn(const Document& document, const std::vector<EdgeRef>& side);
// A run whose edges follow each other only when read backwards, as one lists them who walks along the seam against the
// outlines, is turned round; any other is left as it is. Edges follow each other on their outline, at a corner that is
// sewn, or where they stand.
std::vector<EdgeRef> inOutlineOrder(const Document& document, std::vector<EdgeRef> side);
// A run whose edges stand far apart as they are listed, as those of two fronts named from the wrong side, in the order
// in which they follow each other; any other is left as it is.
std::vector<EdgeRef> asTheyFollow(const Document& document, std::vector<EdgeRef> side);
// A run of edges without what lies beyond so many metres from its first end (or its last). Runs are in the outlines'
// order.
std::vector<EdgeRef> trimmed(const Document& document, const std::vector<EdgeRef>& side, double metres, bool fromLast);

// The same part of an edge on the garment's other half: on the symmetric copy of its piece, on the other half of a
// piece that is symmetric by itself and stands across the body's centre (or nowhere yet), or on a piece of mirrored
// outline that stands on the body's other side. An edge across the centre is its own image. Nothing: it has none.
// `rings`: otherwise what lies over against it on the same edge, as of a waistband that is sewn up at a side.
std::optional<EdgeRef> mirrorImage(const Document& document, const EdgeRef& part, bool rings = false);
// The mirror image of a seam, named for the other side. Refused where a side has none, where the seam is its own image,
// and where the image is sewn already.
Result<SewEdges> mirrorImage(const Document& document, const SewEdges& sew, bool rings = true);

// How many times as long as the other side of a seam a side of this fabric may usually be: sheers 3 to 4 times,
// shirtings 2 to 3, coatings half as long again (the fullness ratios of dressmaking).
double mostGather(const Fabric& fabric);

// A sentence where two edges of one piece that come one after the other in a run do not follow each other on its
// outline, nor over a seam such as a dart's. `side` in the outlines' order.
std::optional<Message> brokenRun(const Document& document, const std::vector<EdgeRef>& side);

// By how much one run is longer than the other, to which it is sewn; of several edges the first and the last are named.
Message longerSaid(const Document& document, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b);
// A sentence where one side is longer by more than is eased in: it is to be gathered, or is a slip.
std::optional<Message> longerSide(const Document& document, const SewEdges& sew);

// Whether side b runs against its own direction. Where seams hold the pieces together already the cloth stays
// two-sided. Otherwise it is judged by how the edges lie and, where that does not tell clearly, by the pieces' right
// sides: outlines of pieces that both turn it away from the body run against each other. `sew` as for the operation.
bool facesReversed(const Document& document, const SewEdges& sew, const Body* body);

// What is possible but hardly meant.
struct SeamDoubt {
  enum class Kind {
    Sewn,       // a part of the edges is sewn already
    Folded,     // two edges that follow each other on one side of a piece
    Twisted,    // the threads cross: the seam runs the wrong way round
    OtherSide,  // left with right, though the right partner is there
    Through,    // the threads run through the body
    Gathered,   // far more than the fabric gathers
  } kind;
  Message what;                          // a sentence
  std::optional<SewEdges> instead = {};  // what was probably meant,
  Message proposal = {};                 // in a few words
};
// The gravest first. What is impossible is no doubt: it is refused by the operation. Without a body nothing is known of
// threads through it.
std::vector<SeamDoubt> seamDoubts(const Document& document, const SewEdges& sew, const Body* body);

}  // namespace karinui
